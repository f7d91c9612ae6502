// SPDX-License-Identifier: MIT
#include "risorius/face/calibration.h"

#include "risorius/face/detail/face_impl.h"

namespace risorius::face {

void Calibration::set_strength(const std::string& muscle, double factor) {
    face_->strength[muscle] = factor;
    face_->equilibrium->moved();
    face_->tissue.forget_mouth();
    face_->tissue.solids().set_strength(muscle, factor);
    std::vector<double>& built_f0_n = face_->built_f0_n;
    if (built_f0_n.empty())
        for (const auto& fibre : face_->tissue.fibres().fibres()) built_f0_n.push_back(fibre.f0_n);
    for (Side side : {Side::kLeft, Side::kRight}) {
        const int column = face_->channels.column(muscle, side);
        if (side == Side::kRight && column == face_->channels.column(muscle, Side::kLeft)) continue;
        for (std::size_t f = 0; f < face_->tissue.fibres().fibres().size(); ++f)
            if (face_->tissue.fibres().fibres()[f].column == column)
                face_->tissue.fibres().set_f0(static_cast<int>(f), factor * built_f0_n[f]);
    }
}

double Calibration::strength(const std::string& muscle) const {
    const auto found = face_->strength.find(muscle);
    return found == face_->strength.end() ? 1.0 : found->second;
}

void Calibration::scale_lips(const rig::LipsDescription& lips) {
    face_->equilibrium->moved();
    face_->tissue.scale_lips(lips);
}

struct Variant::Parts {
    const FaceImpl& face;
    rig::RigDescription rig;
    FaceTissue tissue;
    std::optional<FacePoser> poser;
    Parts(const FaceImpl& of, const rig::RigDescription& changed)
        : face(of), rig(changed), tissue(of.head, rig, of.jaw, of.lids, of.shell, of.mesh) {}
};
Variant::Variant(const Face& face, const rig::RigDescription& changed)
    : parts_(std::make_unique<Parts>(*face.impl_, changed)) {}
Variant::~Variant() = default;

Points Variant::gradient(const Points& nodes, const Eigen::VectorXd& activation,
                         const track::Drive& drive) {
    parts_->tissue.set_boundary_conditions(parts_->face.boundary_state(activation, drive));
    parts_->tissue.begin_rest(nodes);
    return parts_->tissue.static_gradient(nodes, activation);
}

Points Variant::vertices(const Points& nodes, const Eigen::VectorXd& activation,
                         const track::Drive& drive) {
    const FaceImpl& face = parts_->face;
    if (!parts_->poser)
        parts_->poser.emplace(face.head, parts_->rig, face.jaw, face.driven_jaw.joint(), face.lids,
                              face.shell, face.mesh);
    return parts_->poser
        ->pose({nodes, activation, drive, face.driven_jaw.motion(face.now.jaw.q, drive)})
        .vertices;
}

}  // namespace risorius::face
