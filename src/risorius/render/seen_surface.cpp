// SPDX-License-Identifier: MIT
#include "risorius/render/seen_surface.h"

#include <algorithm>
#include <cmath>

namespace risorius::render {

SeenSurface see_surface(const Points& positions, const Triangles& triangles,
                        const Eigen::Matrix4d& clip_from_world, int width_px, int height_px) {
    const auto pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    SeenSurface seen{positions, std::vector<int>(pixels, -1), std::vector<float>(pixels, 0),
                     std::vector<float>(pixels, 0), std::vector<float>(pixels, 2)};

    // Per vertex: x to the right and y down in pixels, depth, and 1 / w. All are linear in the picture.
    Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> corner(positions.rows(), 4);
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
        const Eigen::Vector4d clip =
            clip_from_world * Vec3(positions.row(v).transpose()).homogeneous();
        const double fraction = clip.w() > 0 ? 1 / clip.w() : 0;  // 0: behind the camera
        corner.row(v) << (clip.x() * fraction * 0.5 + 0.5) * width_px,
            (0.5 - clip.y() * fraction * 0.5) * height_px, clip.z() * fraction, fraction;
    }

    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Eigen::Vector4d a = corner.row(triangles(f, 0)), b = corner.row(triangles(f, 1)),
                              c = corner.row(triangles(f, 2));
        if (a[3] <= 0 || b[3] <= 0 || c[3] <= 0) continue;
        const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if (area == 0) continue;
        const auto first = [](double x, double y, double z, int end) {
            return static_cast<int>(
                std::clamp(std::ceil(std::min({x, y, z}) - 0.5), 0.0, static_cast<double>(end)));
        };
        const auto last = [](double x, double y, double z, int end) {
            return static_cast<int>(std::clamp(std::floor(std::max({x, y, z}) - 0.5), -1.0,
                                               static_cast<double>(end - 1)));
        };
        const int x0 = first(a[0], b[0], c[0], width_px), x1 = last(a[0], b[0], c[0], width_px);
        const int y0 = first(a[1], b[1], c[1], height_px), y1 = last(a[1], b[1], c[1], height_px);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const double px = x + 0.5, py = y + 0.5;
                const double wb =
                    ((px - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (py - a[1])) / area;
                const double wc =
                    ((b[0] - a[0]) * (py - a[1]) - (px - a[0]) * (b[1] - a[1])) / area;
                const double wa = 1 - wb - wc;
                if (wa < 0 || wb < 0 || wc < 0) continue;
                const double z = wa * a[2] + wb * b[2] + wc * c[2];
                const std::size_t i =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                    static_cast<std::size_t>(x);
                if (static_cast<float>(z) >= seen.nearness[i] || z < -1) continue;
                const double whole = wa * a[3] + wb * b[3] + wc * c[3];
                seen.nearness[i] = static_cast<float>(z);
                seen.triangle[i] = static_cast<int>(f);
                seen.second[i] = static_cast<float>(wb * b[3] / whole);
                seen.third[i] = static_cast<float>(wc * c[3] / whole);
            }
    }
    return seen;
}

}  // namespace risorius::render
