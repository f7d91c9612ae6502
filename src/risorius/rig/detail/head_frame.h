// SPDX-License-Identifier: MIT
/// \file
/// Places a head in the frame of the atlas: origin between the tragia, x to the subject's left, y up, z forward.
#pragma once

#include <map>
#include <string>

#include "risorius/rig/rig_description.h"

namespace risorius::rig {

struct HeadFrame {
    Mat3 rotation =
        Mat3::Identity();  ///< head = rotation * (mesh units * metres_per_unit) + translation
    Vec3 translation = Vec3::Zero();  ///< m
    double metres_per_unit = 1.0;
    double size = 1.0;        ///< this head / the atlas head, ratio of lengths
    double residual_m = 0.0;  ///< RMS distance of the aligned landmarks from the atlas, m

    Vec3 to_head(const Vec3& mesh_units) const {
        return rotation * (mesh_units * metres_per_unit) + translation;
    }
    Points to_head(const Points& mesh_units) const;
    Points to_mesh(const Points& head) const;
};

/// Rigid fit with scale of the given landmarks (mesh units) to the atlas, made symmetric. The scale is returned as `size`.
HeadFrame find_head_frame(const std::map<std::string, Vec3>& landmarks, const Atlas& atlas,
                          double metres_per_unit);

}  // namespace risorius::rig
