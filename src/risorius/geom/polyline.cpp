// SPDX-License-Identifier: MIT
#include "risorius/geom/polyline.h"

#include <algorithm>
#include <cmath>

namespace risorius::geom {

PolylinePoint nearest_on_polyline(const Vec3& p, const std::vector<Vec3>& line) {
    PolylinePoint nearest;
    double best = 1e300;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec3 along = line[i + 1] - line[i];
        const double t = std::clamp((p - line[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
        const double squared = (p - line[i] - t * along).squaredNorm();
        if (squared < best) best = squared, nearest.piece = i, nearest.fraction = t;
    }
    nearest.distance_m = std::sqrt(best);
    return nearest;
}

double distance_to_polyline(const Vec3& p, const std::vector<Vec3>& line) {
    return nearest_on_polyline(p, line).distance_m;
}

std::vector<Vec3> sample_curve(const std::vector<Vec3>& through, double spacing_m) {
    std::vector<Vec3> out{through.front()};
    for (std::size_t i = 0; i + 1 < through.size(); ++i) {
        const Vec3& p1 = through[i];
        const Vec3& p2 = through[i + 1];
        const Vec3 p0 = i > 0 ? through[i - 1] : Vec3(2 * p1 - p2);
        const Vec3 p3 = i + 2 < through.size() ? through[i + 2] : Vec3(2 * p2 - p1);
        const int pieces = std::max(1, static_cast<int>(std::ceil((p2 - p1).norm() / spacing_m)));
        for (int k = 1; k <= pieces; ++k) {
            const double t = static_cast<double>(k) / pieces;
            out.push_back(0.5 * (2 * p1 + (p2 - p0) * t + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t * t +
                                 (3 * p1 - p0 - 3 * p2 + p3) * t * t * t));
        }
    }
    return out;
}

}  // namespace risorius::geom
