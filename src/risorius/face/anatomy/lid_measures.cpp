// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/lid_measures.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace risorius::face {

double max_lid_gap_m(const rig::Head& head, const EyeLids& lids, const Points& vertices) {
    constexpr int kPlaces = 90, kAngles = 900;
    constexpr double kLowest = -1.0, kAngle = 0.002;  // rad
    std::vector<std::vector<char>> covered(kPlaces, std::vector<char>(kAngles, 0));
    const auto place_at = [](int i) { return -0.03 + 1.06 * i / (kPlaces - 1); };
    for (const Triangles* triangles : {&head.skin, &head.lining})
        for (long f = 0; f < triangles->rows(); ++f) {
            std::array<double, 3> place, angle;
            bool near = true;
            for (int k = 0; k < 3 && near; ++k) {
                const Vec3 p = vertices.row((*triangles)(f, k)).transpose();
                near =
                    (p - lids.centre()).norm() < lids.zone_m() + 16e-3 && p.z() > lids.centre().z();
                place[k] = lids.place_of(p);
                angle[k] = lids.angle_of(p);
            }
            for (int i = 0; near && i < kPlaces; ++i) {
                double low = 1e9, high = -1e9;
                for (int k = 0; k < 3; ++k) {
                    const int l = (k + 1) % 3;
                    if ((place[k] <= place_at(i)) == (place[l] <= place_at(i))) continue;
                    const double t = (place_at(i) - place[k]) / (place[l] - place[k]);
                    low = std::min(low, angle[k] + t * (angle[l] - angle[k]));
                    high = std::max(high, angle[k] + t * (angle[l] - angle[k]));
                }
                for (int a = std::max(0, static_cast<int>(std::ceil((low - kLowest) / kAngle)));
                     a < kAngles && kLowest + a * kAngle <= high; ++a)
                    covered[i][a] = 1;
            }
        }
    int longest = 0;
    for (const std::vector<char>& column : covered) {
        int run = 0;
        for (int a = 100; a < kAngles - 150; ++a) {
            run = column[a] ? 0 : run + 1;
            longest = std::max(longest, run);
        }
    }
    return longest * kAngle * lids.zone_m();
}

double depth_in_eyes_m(const rig::Head& head, const std::array<Mat3, 2>& turn,
                       const Points& vertices) {
    double worst = 0;
    for (int side = 0; side < 2; ++side) {
        const rig::EyeGeometry& eye = head.eyes[side];
        if (!eye.present) continue;
        const Vec3 looks = turn[side] * eye.forward;
        for (long v = 0; v < head.vertices.rows(); ++v) {
            if (head.carrier[v] != rig::Carrier::kSkin) continue;
            const Vec3 before = head.vertices.row(v).transpose();
            if ((before - eye.centre).norm() > eye.radius_m + 8e-3 || before.z() < eye.centre.z())
                continue;
            const double at_rest = eye.distance(before, eye.forward);
            const double now = eye.distance(vertices.row(v).transpose(), looks);
            worst = std::max(worst, std::min(0.0, at_rest) - now);
        }
    }
    return worst;
}

}  // namespace risorius::face
