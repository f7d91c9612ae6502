// What the renderer draws, from a placed head and the mesh it was placed from.
#pragma once

#include "risorius/face/face.h"
#include "risorius/face/view/skull.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/render/scene.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::scene {

render::Scene scene_from_rig(const rig::Head& head, const rig::RigDescription& rig,
                             const geom::PolygonMesh& mesh);

/// What wrinkles the skin may get; before the view is made.
void add_wrinkles(const face::WrinkleLines& lines, render::Scene& scene);

render::Pose pose_for_view(const face::FacePose& pose);

/// What a picture needs to show the muscles: their shapes, once, and what of a frame colours and moves them.
render::Muscles muscles_for_view(const face::MuscleSurfaces& surfaces);
void add_muscles(const face::MuscleSurfaces& surfaces, const Eigen::VectorXd& activation,
                 Points vertices, render::Pose& pose);

/// The bones, the skull's vertices first; and where a pose has them.
render::Bones bones_for_view(const face::Skull& skull);
void add_bones(const face::Skull& skull, const face::FacePose& pose, render::Pose& out);

}  // namespace risorius::scene
