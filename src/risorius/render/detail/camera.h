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
    double azimuth_rad = 0;  ///< 0: in front of the face, positive on its left
    Mat4 clip_from_world;
    double frame_height_m;     ///< height of the visible area at the head
    double portrait_height_m;  ///< the same for a picture of the whole head
    Vec3 backward;             ///< unit vector from the head to the camera
    Vec3 up = Vec3::UnitY();   ///< unit vector in the world that points up in the picture
    bool orthographic = false;

    /// Centre of projection. That of an orthographic camera is so far away that all lines of sight are parallel.
    Vec3 eye_point() const { return orthographic ? Vec3(position + 1e3 * backward) : position; }
};

/// Makes a camera of camera_names(). It frames the head from the landmark of the crown (v) to that of the chin (me) with margins;
/// a close-up frames landmarks of its own. Where landmarks are missing, the box from `skin_min` to `skin_max` (m, world) is
/// framed. `aspect`: width over height of the picture. Throws Error for an unknown camera, with a list of the cameras, and for a
/// field of `lens` out of range.
Camera make_camera(const std::string& name, const std::map<std::string, Vec3>& landmarks,
                   const Vec3& skin_min, const Vec3& skin_max, double aspect,
                   const Lens& lens = {});

/// Returns the clip_from_world matrices of views from points that are spread evenly over the aperture of the lens. Their mean
/// shows depth of field, with the front of the eyes in focus. With an aperture of 0, the only view is that of the camera itself.
std::vector<Mat4> lens_views(const Camera& camera, const std::map<std::string, Vec3>& landmarks,
                             const Lens& lens);

}  // namespace risorius::render
