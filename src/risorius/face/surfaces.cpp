// SPDX-License-Identifier: MIT
#include "risorius/face/surfaces.h"

#include <utility>

#include "risorius/face/detail/face_impl.h"

namespace risorius::face {

const MuscleSurfaces& Surfaces::muscles() const {
    face_->make_surfaces();
    return face_->surfaces;
}

Points Surfaces::muscle_vertices_at(double t_s) const {
    return face_->muscle_vertices(face_->fraction_of_step(t_s));
}

const Triangles& Surfaces::simulated_skin() const { return face_->shell.fine; }

const WrinkleLines& Surfaces::wrinkle_lines() const { return face_->poser->lines(); }

const std::vector<double>& Surfaces::head_fractions() const {
    return face_->poser->followers().head_fractions();
}

Vec3 Surfaces::head_pivot() const { return face_->poser->followers().neck().pivot(); }

FacePose Surfaces::posed(Points vertices, const track::Drive& drive) const {
    return face_->poser->posed(std::move(vertices), face_->complete(drive),
                               face_->driven_jaw.wanted(drive));
}

void Surfaces::fold(FacePose& pose, const track::Drive& drive) const {
    face_->poser->fold(pose, face_->complete(drive).excitation);
}

}  // namespace risorius::face
