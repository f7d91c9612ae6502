// SPDX-License-Identifier: MIT
#include "risorius/face/face.h"

#include <chrono>
#include <utility>

#include "risorius/face/calibration.h"
#include "risorius/face/detail/face_impl.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/fields.h"
#include "risorius/face/statics.h"
#include "risorius/face/surfaces.h"

namespace risorius::face {

Face::Face(const rig::RigDescription& rig, const geom::PolygonMesh& mesh, const Quality& quality,
           const std::string& place) {
    const auto begin = std::chrono::steady_clock::now();
    impl_ = std::make_unique<FaceImpl>(rig, mesh, quality, place);
    impl_->build_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}
Face::~Face() = default;
Face::Face(Face&&) noexcept = default;

void Face::drive_jaw_by(track::JawDrive by) {
    impl_->driven_jaw.drive_by(by, impl_->channels, impl_->motion.effective_step_s(),
                               impl_->tissue);
}
void Face::move(Motion how) { impl_->how = how; }
void Face::set_gravity(const std::optional<Vec3>& gravity_m_s2) { impl_->gravity = gravity_m_s2; }
void Face::set_bite_block(double height_m) { impl_->driven_jaw.set_bite_block(height_m); }

void Face::add_force(std::shared_ptr<solve::EnergyTerm> force) {
    impl_->equilibrium->moved();
    impl_->equilibrium->forget();
    impl_->tissue.add_term(std::move(force));
    impl_->tissue.prepare(impl_->motion.effective_step_s());
}

void Face::start(const DriveAt& drive) { impl_->start(drive); }

StepStats Face::step(const DriveAt& drive) {
    StepStats sum = impl_->substep(drive);
    for (int i = 1; i < impl_->substeps; ++i) {
        const StepStats next = impl_->substep(drive);
        const StepStats before = sum;
        sum = next;
        sum.iterations += before.iterations;
        sum.evaluations += before.evaluations;
        sum.converged = before.converged && next.converged;
    }
    return sum;
}

FacePose Face::pose_at(double t_s, const DriveAt& drive) {
    if (impl_->how == Motion::kQuasiStatic) {
        const track::Drive now = impl_->complete(drive(t_s));
        impl_->history.push_back(impl_->solve_equilibrium(impl_->steady_activation(now), now,
                                                          {.iterations = kRestIterations}));
        return impl_->pose(1.0);
    }
    while (static_cast<double>(impl_->done) < impl_->substeps_until(t_s)) impl_->substep(drive);
    return impl_->pose(impl_->fraction_of_step(t_s));
}

StepStats Face::solve_equilibrium(const Eigen::VectorXd& activation, const track::Drive& kinematic,
                                  const StaticOptions& options) {
    const Eigen::VectorXd given =
        activation.size() > 0
            ? activation
            : Eigen::VectorXd(Eigen::VectorXd::Zero(impl_->channels.column_count()));
    return impl_->solve_equilibrium(impl_->driven_jaw.excitation(given, kinematic),
                                    impl_->complete(kinematic), options);
}

FacePose Face::pose() const { return impl_->pose(1.0); }
double Face::time_s() const { return static_cast<double>(impl_->done) * impl_->substep_s; }
double Face::step_s() const { return impl_->quality.step_s; }
const Eigen::VectorXd& Face::activation() const { return impl_->now.activation; }

Eigen::VectorXd Face::activation_at(double t_s) const {
    return impl_->activation_between(impl_->fraction_of_step(t_s));
}

const rig::Head& Face::head() const { return impl_->head; }

Statics Face::statics() const { return Statics(*impl_); }
Diagnostics Face::diagnostics() const { return Diagnostics(*impl_); }
Surfaces Face::surfaces() const { return Surfaces(*impl_); }
Fields Face::fields() const { return Fields(*impl_); }
Calibration Face::calibration() { return Calibration(*impl_); }

}  // namespace risorius::face
