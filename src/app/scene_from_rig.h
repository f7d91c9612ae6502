// What the renderer draws, from a placed head and the mesh it was placed from.
#pragma once

#include "geom/polygon_mesh.h"
#include "render/scene.h"
#include "rig/head.h"
#include "rig/rig_description.h"
#include "sim/face.h"
#include "sim/skull.h"

namespace risorius::app {

render::Scene scene_from_rig(const rig::Head& head, const rig::RigDescription& rig,
                             const geom::PolygonMesh& mesh);

/// What wrinkles the skin may get; before the view is made.
void add_wrinkles(const sim::WrinkleLines& lines, render::Scene& scene);

render::Pose pose_for_view(const sim::FacePose& pose);

/// What a picture needs to show the muscles: their shapes, once, and what of a frame colours and moves them.
render::Muscles muscles_for_view(const sim::MuscleSurfaces& surfaces);
void add_muscles(const sim::MuscleSurfaces& surfaces, const Eigen::VectorXd& activation,
                 Points vertices, render::Pose& pose);

/// The bones, the skull's vertices first; and where a pose has them.
render::Bones bones_for_view(const sim::Skull& skull);
void add_bones(const sim::Skull& skull, const sim::FacePose& pose, render::Pose& out);

}  // namespace risorius::app
