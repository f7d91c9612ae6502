// SPDX-License-Identifier: MIT
/// \file
/// Data for drawing a face besides its pose: the surfaces of the muscles, the wrinkle lines, and poses from vertices that something
/// other than the simulation has moved.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/muscle/detail/muscle_surface.h"
#include "risorius/face/skin/detail/face_pose.h"
#include "risorius/face/skin/detail/wrinkle_lines.h"
#include "risorius/track/channels.h"

namespace risorius::face {

struct FaceImpl;

/// A view of a Face, from Face::surfaces(). V is the number of vertices of the mesh of the head.
class Surfaces {
  public:
    explicit Surfaces(FaceImpl& face) : face_(&face) {}

    /// Returns the muscles as closed surfaces at rest, m, in the head frame. The first call builds them.
    const MuscleSurfaces& muscles() const;
    /// Returns the vertices of muscles() at the time t_s, in the world frame, m. Call it after Face::pose_at() with the same t_s.
    Points muscle_vertices_at(double t_s) const;

    /// Returns the triangles of the skin that are simulated, F x 3 indices of mesh vertices.
    const Triangles& simulated_skin() const;
    /// Returns the pattern of wrinkle lines that FacePose::fold_depth refers to. It is empty when the rig has none.
    const WrinkleLines& wrinkle_lines() const;

    /// Returns the fraction of the motion of the head that each vertex of the mesh follows: 1 above the jaw line, 0 at the base of
    /// the neck. It turns by this fraction about the pivot, the atlanto-occipital joint (m, head frame).
    const std::vector<double>& head_fractions() const;
    Vec3 head_pivot() const;

    /// Makes a pose from vertices, V x 3, m, in the head frame, that something other than the simulation has moved. The eyes, the jaw
    /// and the motion of the head are those of the drive.
    FacePose posed(Points vertices, const track::Drive& drive) const;
    /// Computes FacePose::fold_depth of such a pose from the strain of its skin. Do not call it from several
    /// threads at once.
    void fold(FacePose& pose, const track::Drive& drive) const;

  private:
    FaceImpl* face_;
};

}  // namespace risorius::face
