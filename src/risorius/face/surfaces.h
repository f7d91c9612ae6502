// SPDX-License-Identifier: MIT
/// \file
/// What is drawn of a face besides its pose: muscles, wrinkles, and vertices that something else has moved.
#pragma once

#include "risorius/core/types.h"
#include "risorius/face/muscle/detail/muscle_surface.h"
#include "risorius/face/skin/detail/face_pose.h"
#include "risorius/face/skin/detail/wrinkle_lines.h"
#include "risorius/track/channels.h"

namespace risorius::face {

struct FaceImpl;

/// A view of a Face, from Face::surfaces(). Positions are in m. V is the number of vertices of the mesh of the head.
class Surfaces {
  public:
    explicit Surfaces(FaceImpl& face) : face_(&face) {}

    /// The muscles as closed surfaces at rest. They are built at the first call.
    const MuscleSurfaces& muscles() const;
    /// Returns the vertices of muscles(), with the motion of the head, at the time of the last Face::pose_at(t_s).
    Points muscle_vertices_at(double t_s) const;

    /// The part of the skin that is simulated, F x 3 vertices of the mesh.
    const Triangles& simulated_skin() const;
    /// The pattern of wrinkles that FacePose::fold_depth refers to. It is empty when the rig has none.
    const WrinkleLines& wrinkle_lines() const;

    /// Makes a pose from V x 3 vertices that something else has moved, in the head frame. Eyes, jaw and the motion of the head
    /// are those of the drive.
    FacePose posed(Points vertices, const track::Drive& drive) const;
    /// Computes FacePose::fold_depth of such a pose from the strain of its skin. One thread at a time.
    void fold(FacePose& pose, const track::Drive& drive) const;

  private:
    FaceImpl* face_;
};

}  // namespace risorius::face
