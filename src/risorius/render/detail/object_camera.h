// SPDX-License-Identifier: MIT
/// \file
/// Cameras for a row of objects, one for each object. All have the same direction, distance and scale; each is centred on its own
/// object.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::render {

/// Camera axes in the world, each of unit length.
struct ObjectAxes {
    Vec3 right, up, backward;
};
ObjectAxes object_axes(double azimuth_deg, double elevation_deg);

struct ObjectCamera {
    Vec3 position;  ///< m
    /// It gives every point the depth 0, so that nothing is clipped
    Eigen::Matrix4d clip_from_world;
};

struct ObjectRow {
    ObjectAxes axes;
    std::vector<ObjectCamera> cameras;  ///< one per object
    double reach_m;                     ///< radius of the largest object about its centre
    double distance_m;                  ///< from a camera to the centre of its object
    double pixel_m;                     ///< size of a pixel at that distance
};

/// Frames every vertex of every object, with a margin.
ObjectRow frame_objects(const std::vector<const Points*>& objects, const ObjectAxes& axes,
                        int width_px, int height_px);

}  // namespace risorius::render
