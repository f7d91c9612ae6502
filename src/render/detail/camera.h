// Named portrait cameras, framed on the landmarks so that any head fills the picture the same way.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "core/types.h"

namespace risorius::render {

using Mat4 = Eigen::Matrix4d;

struct Camera {
    Vec3 position;           ///< m, world
    double azimuth_rad = 0;  ///< from straight ahead of the face towards its left
    Mat4 clip_from_world;
    double frame_height_m;  ///< height of what is seen at the head
};

/// Frames crown (v) to chin (me) with margins, and the box of the skin where they are missing.
/// Throws Error naming the cameras for an unknown one.
Camera make_camera(const std::string& name, const std::map<std::string, Vec3>& landmarks,
                   const Vec3& skin_min, const Vec3& skin_max, double aspect);

}  // namespace risorius::render
