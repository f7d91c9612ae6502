// SPDX-License-Identifier: MIT
// The drawn surface of a grid of cells: smooth and closed.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "risorius/face/muscle/detail/grid_belly.h"
#include "risorius/geom/polyline.h"

namespace risorius::face {

// A smooth tube through the border of the grid, twice as fine around and three times as fine along it, closed by fans at both ends.
BellySurface GridBelly::surface(const std::array<bool, 2>& bone_ends) const {
    constexpr int kAround = 2, kAlong = 3;
    const tissue::GridShape& grid = place_.grid;
    BellySurface out;
    std::vector<std::pair<int, int>> border;  // n, o; from inside to outside seen along the fibres
    for (int n = 0; n < grid.n; ++n) border.emplace_back(n, 0);
    for (int o = 1; o < grid.o; ++o) border.emplace_back(grid.n - 1, o);
    for (int n = grid.n - 1; n-- > 0;) border.emplace_back(n, grid.o - 1);
    for (int o = grid.o - 1; o-- > 1;) border.emplace_back(0, o);
    const int around = static_cast<int>(border.size()), ring = kAround * around,
              slabs = kAlong * (grid.m - 1) + 1;
    // Catmull-Rom weights of four neighbours at t
    const auto weights = [](double t) {
        return std::array<double, 4>{
            0.5 * (-t + 2 * t * t - t * t * t), 0.5 * (2 - 5 * t * t + 3 * t * t * t),
            0.5 * (t + 4 * t * t - 3 * t * t * t), 0.5 * (-t * t + t * t * t)};
    };
    std::vector<Eigen::Triplet<double>> entries;
    for (int s = 0; s < slabs; ++s)
        for (int r = 0; r < ring; ++r) {
            const int m0 = std::min(s / kAlong, grid.m - 2), c0 = r / kAround;
            const auto along = weights(s / static_cast<double>(kAlong) - m0),
                       turn = weights(r % kAround / static_cast<double>(kAround));
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j) {
                    // Beyond an end the grid goes straight on: p(-1) = 2 p(0) - p(1)
                    const int m = m0 + i - 1;
                    const auto [n, o] =
                        border[static_cast<std::size_t>((c0 + j - 1 + around) % around)];
                    const double w =
                        along[static_cast<std::size_t>(i)] * turn[static_cast<std::size_t>(j)];
                    const int row = s * ring + r;
                    if (m < 0) {
                        entries.emplace_back(row, grid.index(0, n, o), 2 * w);
                        entries.emplace_back(row, grid.index(1, n, o), -w);
                    } else if (m >= grid.m) {
                        entries.emplace_back(row, grid.index(grid.m - 1, n, o), 2 * w);
                        entries.emplace_back(row, grid.index(grid.m - 2, n, o), -w);
                    } else {
                        entries.emplace_back(row, grid.index(m, n, o), w);
                    }
                }
        }
    // The middle of each end
    for (int end = 0; end < 2; ++end)
        for (const auto& [n, o] : border)
            entries.emplace_back(slabs * ring + end, grid.index(end == 0 ? 0 : grid.m - 1, n, o),
                                 1.0 / around);
    out.weights.resize(slabs * ring + 2, grid.size());
    out.weights.setFromTriplets(entries.begin(), entries.end());
    Triangles triangles(2L * ring * (slabs - 1) + 2L * ring, 3);
    long f = 0;
    for (int r = 0; r < ring; ++r) {
        const int next = (r + 1) % ring;
        for (int s = 0; s + 1 < slabs; ++s) {
            const int a = s * ring + r, b = s * ring + next, c = a + ring, d = b + ring;
            triangles.row(f++) << a, b, c;
            triangles.row(f++) << b, d, c;
        }
        triangles.row(f++) << slabs * ring, next, r;
        triangles.row(f++) << slabs * ring + 1, (slabs - 1) * ring + r, (slabs - 1) * ring + next;
    }

    // Along and across the fibres; tendon where a muscle with one meets bone
    const Points rest = out.weights * rest_;
    TexCoords fibre(rest.rows(), 2);
    std::vector<double> tendon(static_cast<std::size_t>(rest.rows()), 0.0);
    std::vector<double> length{0.0};
    for (int s = 1; s < slabs; ++s)
        length.push_back(length.back() + (rest.middleRows(s * ring, ring).colwise().mean() -
                                          rest.middleRows((s - 1) * ring, ring).colwise().mean())
                                             .norm());
    const rig::Muscle& muscle = *place_.muscle;
    for (int s = 0; s < slabs; ++s) {
        double around_m = 0;
        for (int r = 0; r < ring; ++r) {
            const int row = s * ring + r;
            if (r > 0) around_m += (rest.row(row) - rest.row(row - 1)).norm();
            const double along = length[static_cast<std::size_t>(s)];
            fibre.row(row) << along, around_m;
            const double from_bone =
                std::min(bone_ends[0] ? along : 1e9, bone_ends[1] ? length.back() - along : 1e9);
            const double tendon_m = std::min(0.5 * muscle.tendon_slack_m, 0.12 * length.back());
            tendon[static_cast<std::size_t>(row)] =
                1 - geom::smoothstep(0.5 * tendon_m, 1.5 * tendon_m + 1e-9, from_bone);
        }
    }
    for (int end = 0; end < 2; ++end) {
        const int middle = slabs * ring + end, beside = end == 0 ? 0 : (slabs - 1) * ring;
        fibre.row(middle) = fibre.row(beside);
        tendon[static_cast<std::size_t>(middle)] = tendon[static_cast<std::size_t>(beside)];
    }
    out.triangles = std::move(triangles);
    out.fibre = std::move(fibre);
    out.tendon = std::move(tendon);
    return out;
}

}  // namespace risorius::face
