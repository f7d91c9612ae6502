// SPDX-License-Identifier: MIT
#include "risorius/face/statics.h"

#include "risorius/face/detail/face_impl.h"

namespace risorius::face {

const Points& Statics::nodes() const { return face_->now.x; }

KeptEquilibrium Statics::keep() const {
    const Equilibrium::Pose pose = face_->equilibrium_pose();
    return {pose.x, pose.activation, pose.drive};
}

void Statics::go_back_to(const KeptEquilibrium& kept) {
    face_->go_back_to(FaceImpl::State{kept.nodes, kept.activation, kept.drive, {}});
}

Points Statics::gradient(const Points& nodes, const Eigen::VectorXd& activation,
                         const track::Drive& drive) const {
    return face_->equilibrium->gradient(face_->equilibrium_pose(), nodes, activation, drive);
}

Points Statics::solve(const Points& b) const {
    return face_->equilibrium->solve(face_->equilibrium_pose(), b);
}

std::vector<Points> Statics::sensitivities(std::span<const int> columns,
                                           std::span<const track::Kinematic> channels) const {
    return face_->equilibrium->sensitivities(face_->equilibrium_pose(), columns, channels);
}

Points Statics::pull_back(const Points& vertex_gradient) const {
    return face_->poser->pull_back({face_->now.x, face_->now.activation, face_->now.drive,
                                    face_->driven_jaw.motion(face_->now.jaw.q, face_->now.drive)},
                                   vertex_gradient);
}

}  // namespace risorius::face
