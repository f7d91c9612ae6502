// SPDX-License-Identifier: MIT
// A surface that is its own mirror image is recognised and coarsened in pairs. Other surfaces are not changed.
#include "risorius/geom/mirror.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "risorius/geom/surface_topology.h"

namespace risorius::geom {
namespace {

struct Vault {
    Points points;
    Triangles triangles;
};

/// A vault of n x n cells about the plane x = middle. All cells are cut along the same diagonal, so the triangles are not
/// mirrored.
Vault vault(int n, double middle, double tilt = 0.0) {
    Vault out;
    out.points.resize((n + 1) * (n + 1), 3);
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double x = 2.0 * i / n - 1, y = 2.0 * j / n - 1;
            out.points.row(j * (n + 1) + i) << x + middle + tilt * y, y - tilt * x,
                0.4 * (1 - x * x) * (1 - 0.5 * y * y);
        }
    out.triangles.resize(2 * n * n, 3);
    for (int j = 0, f = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            out.triangles.row(f++) << a, b, d;
            out.triangles.row(f++) << a, d, c;
        }
    return out;
}

std::set<std::array<int, 3>> faces(const Triangles& triangles, const std::vector<int>* partner) {
    std::set<std::array<int, 3>> out;
    for (long f = 0; f < triangles.rows(); ++f) {
        std::array<int, 3> face{triangles(f, 0), triangles(f, 1), triangles(f, 2)};
        if (partner)
            for (int& v : face) v = (*partner)[v];
        std::sort(face.begin(), face.end());
        out.insert(face);
    }
    return out;
}

TEST(MirrorPairs, AreFoundThoughTheFirstGuessOfThePlaneIsOff) {
    const Vault sheet = vault(12, 0.02, 0.01);
    const MirrorPairs mirror = find_mirror_pairs(sheet.triangles, sheet.points, Vec3::UnitX(), 0);
    ASSERT_TRUE(mirror.found());
    for (int j = 0; j <= 12; ++j)
        for (int i = 0; i <= 12; ++i) EXPECT_EQ(mirror.partner[j * 13 + i], j * 13 + 12 - i);
}

TEST(MirrorPairs, AreNotFoundWhereOneVertexIsElsewhere) {
    Vault sheet = vault(12, 0);
    sheet.points(15, 1) += 0.08;
    EXPECT_FALSE(find_mirror_pairs(sheet.triangles, sheet.points, Vec3::UnitX(), 0).found());
}

TEST(MirrorPairs, AreNotFoundWithoutALineOfVerticesBetweenTheHalves) {
    const Vault sheet = vault(11, 0);
    EXPECT_FALSE(find_mirror_pairs(sheet.triangles, sheet.points, Vec3::UnitX(), 0).found());
}

TEST(DecimateMirrored, GivesASurfaceThatIsItsOwnMirrorImage) {
    const Vault sheet = vault(40, 0);
    const MirrorPairs mirror = find_mirror_pairs(sheet.triangles, sheet.points, Vec3::UnitX(), 0);
    ASSERT_TRUE(mirror.found());
    const Triangles half = first_half(sheet.triangles, sheet.points, mirror);
    const std::vector<double> length(static_cast<std::size_t>(sheet.points.rows()), 0.15);
    const Decimated coarse = decimate_mirrored(half, sheet.points, length, mirror);
    EXPECT_LT(coarse.kept.size(), 500u);
    EXPECT_GT(coarse.kept.size(), 100u);
    EXPECT_EQ(faces(coarse.triangles, nullptr), faces(coarse.triangles, &mirror.partner));

    // A single sheet, without a cut or a doubled edge along the seam.
    const SurfaceEdges edges = surface_edges(coarse.triangles);
    for (int e = 0; e < edges.count(); ++e) ASSERT_LE(edges.triangle_count(e), 2);
    EXPECT_EQ(boundary_loops(coarse.triangles, edges).size(), 1u);
    EXPECT_EQ(static_cast<long>(coarse.kept.size()) - edges.count() + coarse.triangles.rows(), 1);
    for (std::size_t v = 0; v < mirror.partner.size(); ++v)
        EXPECT_EQ(coarse.collapsed_to[mirror.partner[v]], mirror.partner[coarse.collapsed_to[v]]);
}

}  // namespace
}  // namespace risorius::geom
