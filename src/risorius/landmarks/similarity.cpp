// SPDX-License-Identifier: MIT
#include "risorius/landmarks/similarity.h"

#include "risorius/core/rotations.h"

namespace risorius::landmarks {

Similarity Similarity::inverse() const {
    Similarity out;
    out.scale = 1 / scale;
    out.rotation = rotation.transpose();
    out.shift = -out.scale * (out.rotation * shift);
    return out;
}

Similarity nearest_similarity(const std::vector<Vec3>& from, const std::vector<Vec3>& to,
                              const std::vector<double>& weights) {
    const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
    double all = 0, spread = 0;
    Vec3 from_mean = Vec3::Zero(), to_mean = Vec3::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
        all += weight(i);
        from_mean += weight(i) * from[i];
        to_mean += weight(i) * to[i];
    }
    from_mean /= all;
    to_mean /= all;
    Mat3 covariance = Mat3::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
        covariance += weight(i) * (to[i] - to_mean) * (from[i] - from_mean).transpose();
        spread += weight(i) * (from[i] - from_mean).squaredNorm();
    }
    const NearestRotation nearest = nearest_rotation(covariance);
    Similarity out;
    out.rotation = nearest.rotation;
    out.scale = nearest.stretch.sum() / spread;
    out.shift = to_mean - out.scale * (out.rotation * from_mean);
    return out;
}

}  // namespace risorius::landmarks
