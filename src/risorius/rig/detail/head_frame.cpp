// SPDX-License-Identifier: MIT
#include "risorius/rig/detail/head_frame.h"

#include "risorius/core/rotations.h"

namespace risorius::rig {

Points HeadFrame::to_head(const Points& mesh_units) const {
    Points out = (mesh_units * (metres_per_unit * rotation.transpose()));
    out.rowwise() += translation.transpose();
    return out;
}

Points HeadFrame::to_mesh(const Points& head) const {
    Points centred = head;
    centred.rowwise() -= translation.transpose();
    return centred * (rotation / metres_per_unit);
}

HeadFrame find_head_frame(const std::map<std::string, Vec3>& landmarks, const Atlas& atlas,
                          double metres_per_unit) {
    std::vector<Vec3> here, there;
    for (const auto& [id, p] : landmarks)
        if (const AtlasLandmark* a = atlas.landmark(id)) {
            here.push_back(p * metres_per_unit);
            there.push_back(a->position);
        }
    const double n = static_cast<double>(here.size());
    Vec3 here_mean = Vec3::Zero(), there_mean = Vec3::Zero();
    for (std::size_t i = 0; i < here.size(); ++i) {
        here_mean += here[i] / n;
        there_mean += there[i] / n;
    }
    Mat3 covariance = Mat3::Zero();
    double here_spread = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
        covariance += (there[i] - there_mean) * (here[i] - here_mean).transpose();
        here_spread += (here[i] - here_mean).squaredNorm();
    }
    const NearestRotation nearest = nearest_rotation(covariance);

    HeadFrame frame;
    frame.metres_per_unit = metres_per_unit;
    frame.rotation = nearest.rotation;
    const double atlas_per_here = nearest.stretch.sum() / here_spread;
    frame.size = 1.0 / atlas_per_here;
    // The tragia define the origin. If they are missing, those of the scaled atlas are used.
    frame.translation = frame.size * there_mean - frame.rotation * here_mean;
    const auto left = landmarks.find("t_l"), right = landmarks.find("t_r");
    if (left != landmarks.end() && right != landmarks.end())
        frame.translation =
            -(frame.rotation * (0.5 * metres_per_unit * (left->second + right->second)));

    double squared = 0;
    for (std::size_t i = 0; i < here.size(); ++i)
        squared +=
            (frame.rotation * here[i] + frame.translation - frame.size * there[i]).squaredNorm();
    frame.residual_m = std::sqrt(squared / n);
    return frame;
}

}  // namespace risorius::rig
