// SPDX-License-Identifier: MIT
#include "risorius/scene/landmark_points.h"

namespace risorius::scene {

LandmarkPoints::LandmarkPoints(const rig::Head& head, const rig::RigDescription& rig) {
    for (const auto& [id, position] : head.landmarks) {
        const auto given = rig.landmarks.find(id);
        if (given != rig.landmarks.end() && given->second.vertex >= 0) {
            riders_[id] = {given->second.vertex, Vec3::Zero()};
            continue;
        }
        int nearest = -1;
        double min_squared = 0;
        for (long f = 0; f < head.skin.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int v = head.skin(f, k);
                const double squared = (head.vertices.row(v).transpose() - position).squaredNorm();
                if (nearest < 0 || squared < min_squared) {
                    nearest = v;
                    min_squared = squared;
                }
            }
        riders_[id] = {nearest, position - head.vertices.row(nearest).transpose()};
    }
}

Vec3 LandmarkPoints::at(const std::string& id, const Points& vertices) const {
    const Rider& rider = riders_.at(id);
    return vertices.row(rider.vertex).transpose() + rider.offset;
}

std::vector<std::string> LandmarkPoints::ids() const {
    std::vector<std::string> out;
    for (const auto& [id, rider] : riders_) out.push_back(id);
    return out;
}

}  // namespace risorius::scene
