// SPDX-License-Identifier: MIT
/// \file
/// Places a head in the frame of the atlas: origin between the tragia, x to the subject's left, y up, z forward.
#pragma once

#include <map>
#include <string>

#include "risorius/rig/rig_description.h"

namespace risorius::rig {

struct HeadFrame {
    /// Position in the head frame = rotation * (position in the mesh * metres_per_unit) + translation
    Mat3 rotation = Mat3::Identity();
    Vec3 translation = Vec3::Zero();  ///< m
    double metres_per_unit = 1.0;
    double size = 1.0;        ///< ratio of lengths, this head over the atlas head
    double residual_m = 0.0;  ///< RMS distance of the aligned landmarks from the atlas, m

    Vec3 to_head(const Vec3& mesh_units) const {
        return rotation * (mesh_units * metres_per_unit) + translation;
    }
    Points to_head(const Points& mesh_units) const;
    Points to_mesh(const Points& head) const;
};

/// Fits the given landmarks (mesh units) to the atlas by a rigid motion with scale. The landmarks are made symmetric first. The
/// inverse of the scale is returned as HeadFrame::size.
HeadFrame find_head_frame(const std::map<std::string, Vec3>& landmarks, const Atlas& atlas,
                          double metres_per_unit);

}  // namespace risorius::rig
