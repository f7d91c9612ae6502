// SPDX-License-Identifier: MIT
/// \file
/// The motion with a scale that brings points nearest to others, in the weighted least squares sense (Umeyama 1991).
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::landmarks {

/// p -> scale rotation p + shift
struct Similarity {
    double scale = 1;
    Mat3 rotation = Mat3::Identity();
    Vec3 shift = Vec3::Zero();

    Vec3 operator()(const Vec3& p) const { return scale * (rotation * p) + shift; }
    Similarity inverse() const;
};

/// `weights`: one per point, >= 0, or empty.
Similarity nearest_similarity(const std::vector<Vec3>& from, const std::vector<Vec3>& to,
                              const std::vector<double>& weights = {});

}  // namespace risorius::landmarks
