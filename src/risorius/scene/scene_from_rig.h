// SPDX-License-Identifier: MIT
/// \file
/// Makes the scene for the renderer, and the pose of a frame, from a head and its face.
#pragma once

#include <string>
#include <vector>

#include "risorius/face/surfaces.h"
#include "risorius/face/view/skull.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/render/scene.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::scene {

/// Says which pictures of a mesh cannot be had or read, and why.
std::vector<std::string> picture_problems(const geom::PolygonMesh& mesh);

/// Returns the scene of a head. Where a picture cannot be had, the surface has the colours of the look.
render::Scene scene_from_rig(const rig::Head& head, const rig::RigDescription& rig,
                             const geom::PolygonMesh& mesh);

/// Adds the lines along which the skin can wrinkle. Call it before a view of the scene is made.
void add_wrinkles(const face::WrinkleLines& lines, render::Scene& scene);

/// Returns the pose of a frame for the renderer.
render::Pose pose_for_view(const face::FacePose& pose);

/// The first function returns the muscles for the scene. The second one adds their activations (shown as colours) and positions
/// to the pose of a frame.
render::Muscles muscles_for_view(const face::MuscleSurfaces& surfaces);
void add_muscles(const face::MuscleSurfaces& surfaces, const Eigen::VectorXd& activation,
                 Points vertices, render::Pose& pose);

/// The first function returns the bones for the scene, with the vertices of the skull first. The second one adds their positions
/// to the pose of a frame.
render::Bones bones_for_view(const face::Skull& skull);
void add_bones(const face::Skull& skull, const face::FacePose& pose, render::Pose& out);

}  // namespace risorius::scene
