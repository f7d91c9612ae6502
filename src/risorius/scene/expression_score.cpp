// SPDX-License-Identifier: MIT
#include "risorius/scene/expression_score.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/face/surfaces.h"

namespace risorius::scene {

Json ExpressionScore::json() const {
    return json_object({{"cosine", cosine},
                        {"relative_error", relative},
                        {"rms_mm", 1e3 * rms_m},
                        {"rms_moved_mm", 1e3 * rms_moved_m},
                        {"max_mm", 1e3 * max_m},
                        {"landmark_mm", 1e3 * landmark_m},
                        {"measured_peak_mm", 1e3 * peak_m},
                        {"simulated_peak_mm", 1e3 * simulated_peak_m}});
}

Eigen::VectorXd vertex_areas(const Triangles& triangles, const Points& rest) {
    Eigen::VectorXd area = Eigen::VectorXd::Zero(rest.rows());
    for (long f = 0; f < triangles.rows(); ++f) {
        const Vec3 a = rest.row(triangles(f, 0)), b = rest.row(triangles(f, 1)),
                   c = rest.row(triangles(f, 2));
        const double third = (b - a).cross(c - a).norm() / 6;
        for (int k = 0; k < 3; ++k) area[triangles(f, k)] += third;
    }
    return area;
}

Eigen::VectorXd seen_areas(const face::Face& face) {
    constexpr double kOtherThanSkin = 0.2;
    Eigen::VectorXd out = vertex_areas(face.surfaces().simulated_skin(), face.head().vertices);
    const double mean = out.sum() / static_cast<double>((out.array() > 0).count());
    for (long v = 0; v < out.size(); ++v) {
        const rig::Carrier carrier = face.head().carrier[static_cast<std::size_t>(v)];
        if (carrier != rig::Carrier::kSkin && carrier != rig::Carrier::kNone)
            out[v] += kOtherThanSkin * mean;
    }
    return out;
}

ExpressionScore score(const Points& simulated, const Points& measured, const Eigen::VectorXd& area,
                      const std::vector<int>& landmark_vertices) {
    constexpr double kMoved_m = 0.5e-3;
    double uu = 0, gg = 0, ug = 0, dd = 0, all = 0, moved_dd = 0, moved = 0;
    ExpressionScore out;
    for (long v = 0; v < area.size(); ++v) {
        if (area[v] == 0) continue;
        const Vec3 u = simulated.row(v), g = measured.row(v);
        const double miss = (u - g).squaredNorm();
        uu += area[v] * u.squaredNorm();
        gg += area[v] * g.squaredNorm();
        ug += area[v] * u.dot(g);
        dd += area[v] * miss;
        all += area[v];
        out.max_m = std::max(out.max_m, std::sqrt(miss));
        out.peak_m = std::max(out.peak_m, g.norm());
        out.simulated_peak_m = std::max(out.simulated_peak_m, u.norm());
        if (u.norm() > kMoved_m || g.norm() > kMoved_m) {
            moved_dd += area[v] * miss;
            moved += area[v];
        }
    }
    if (uu > 0 && gg > 0) out.cosine = ug / std::sqrt(uu * gg);
    if (gg > 0) out.relative = std::sqrt(dd / gg);
    if (all > 0) out.rms_m = std::sqrt(dd / all);
    if (moved > 0) out.rms_moved_m = std::sqrt(moved_dd / moved);
    for (const int v : landmark_vertices)
        out.landmark_m += (simulated.row(v) - measured.row(v)).norm() /
                          static_cast<double>(landmark_vertices.size());
    return out;
}

}  // namespace risorius::scene
