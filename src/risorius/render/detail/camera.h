// SPDX-License-Identifier: MIT
/// \file
/// Named portrait cameras, framed by landmarks so that every head fills the picture in the same way.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {

using Mat4 = Eigen::Matrix4d;

struct Camera {
    Vec3 position;           ///< m, world
    double azimuth_rad = 0;  ///< from straight ahead of the face towards its left
    Mat4 clip_from_world;
    double frame_height_m;     ///< height of what is seen at the head
    double portrait_height_m;  ///< the same of a picture of the whole head
    Vec3 backward;             ///< unit, from the head to the camera
    Vec3 up = Vec3::UnitY();   ///< unit, of the picture
    bool orthographic = false;

    /// The point where lines of sight meet; for an orthographic camera so far away that they are parallel.
    Vec3 eye_point() const { return orthographic ? Vec3(position + 1e3 * backward) : position; }
};

/// Frames crown (v) to chin (me) with margins, or a close-up its own landmarks, and the box of the skin where they are missing.
/// Throws Error naming the cameras for an unknown one, and what of the lens is out of range.
Camera make_camera(const std::string& name, const std::map<std::string, Vec3>& landmarks,
                   const Vec3& skin_min, const Vec3& skin_max, double aspect,
                   const Lens& lens = {});

/// The camera moved to points of its lens' aperture, distributed evenly, so that the plane of the eyes stays in focus; the camera itself
/// when it has no aperture.
std::vector<Mat4> lens_views(const Camera& camera, const std::map<std::string, Vec3>& landmarks,
                             const Lens& lens);

}  // namespace risorius::render
