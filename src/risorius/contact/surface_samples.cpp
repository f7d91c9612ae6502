// SPDX-License-Identifier: MIT
#include "risorius/contact/surface_samples.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

namespace risorius::contact {

std::vector<ContactSample> surface_samples(const Points& rest, const Triangles& triangles,
                                           int per_side) {
    assert(per_side >= 1);
    const int n = per_side;
    // Points on shared corners and sides are identified by their nodes and fractions.
    using Key = std::array<std::pair<int, int>, 3>;
    std::map<Key, std::size_t> found;
    std::vector<ContactSample> samples;
    const auto sample_at = [&](long t, const std::array<int, 3>& fractions) -> ContactSample& {
        Key key;
        for (int k = 0; k < 3; ++k)
            key[k] = fractions[k] > 0 ? std::pair(triangles(t, k), fractions[k]) : std::pair(-1, 0);
        std::sort(key.begin(), key.end());
        const auto [place, is_new] = found.try_emplace(key, samples.size());
        if (is_new) {
            ContactSample sample{{}, 0};
            for (const auto& [node, fraction] : key)
                if (fraction > 0) sample.point.add(node, fraction / static_cast<double>(n));
            samples.push_back(sample);
        }
        return samples[place->second];
    };
    for (long t = 0; t < triangles.rows(); ++t) {
        const Vec3 a = rest.row(triangles(t, 0)).transpose();
        const Vec3 ab = rest.row(triangles(t, 1)).transpose() - a;
        const Vec3 ac = rest.row(triangles(t, 2)).transpose() - a;
        const double third = ab.cross(ac).norm() / 2 / (n * n) / 3;
        const auto give = [&](int i, int j) { sample_at(t, {n - i - j, i, j}).area_m2 += third; };
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n - i; ++j) {
                give(i, j), give(i + 1, j), give(i, j + 1);
                if (i + j + 2 <= n) give(i + 1, j), give(i, j + 1), give(i + 1, j + 1);
            }
    }
    return samples;
}

std::vector<ContactSample> node_samples(const std::vector<int>& nodes, double area_m2) {
    std::vector<ContactSample> samples;
    for (const int node : nodes) samples.push_back({solve::NodeBlend(node), area_m2});
    return samples;
}

int parts_per_side(const Points& rest, const Triangles& triangles, double spacing_m) {
    double longest = 0;
    for (long t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            longest = std::max(
                longest, (rest.row(triangles(t, k)) - rest.row(triangles(t, (k + 1) % 3))).norm());
    return std::max(1, static_cast<int>(std::ceil(longest / spacing_m - 1e-9)));
}

}  // namespace risorius::contact
