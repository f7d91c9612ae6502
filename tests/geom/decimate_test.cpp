// SPDX-License-Identifier: MIT
// Coarsening preserves the surface: its outline, its sides and the requested sizes.
#include "risorius/geom/decimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "risorius/geom/surface_topology.h"

namespace risorius::geom {
namespace {

struct Sheet {
    Points points;
    Triangles triangles;
};

/// A square metre of n x n cells, bulging like a low dome, cut along alternating diagonals.
Sheet dome(int n, double height = 0.1) {
    Sheet out;
    out.points.resize((n + 1) * (n + 1), 3);
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
            out.points.row(j * (n + 1) + i) << x, y, 16 * height * x * (1 - x) * y * (1 - y);
        }
    out.triangles.resize(2 * n * n, 3);
    long f = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            if ((i + j) % 2 == 0) {
                out.triangles.row(f++) << a, b, d;
                out.triangles.row(f++) << a, d, c;
            } else {
                out.triangles.row(f++) << a, b, c;
                out.triangles.row(f++) << b, d, c;
            }
        }
    return out;
}

Vec3 normal(const Points& points, const Triangles& triangles, long f) {
    const Vec3 a = points.row(triangles(f, 0)), b = points.row(triangles(f, 1)),
               c = points.row(triangles(f, 2));
    return (b - a).cross(c - a);
}

double mean_edge(const Sheet& sheet, const Triangles& triangles) {
    double sum = 0;
    const SurfaceEdges edges = surface_edges(triangles);
    for (const auto& e : edges.vertices)
        sum += (sheet.points.row(e[0]) - sheet.points.row(e[1])).norm();
    return sum / edges.count();
}

TEST(Decimate, EdgesComeNearTheWantedLength) {
    const Sheet sheet = dome(40);
    for (double wanted : {0.05, 0.1, 0.15}) {
        const Decimated coarse = decimate(
            sheet.triangles, sheet.points,
            std::vector<double>(static_cast<std::size_t>(sheet.points.rows()), wanted), {});
        EXPECT_NEAR(mean_edge(sheet, coarse.triangles), wanted, 0.25 * wanted);
        const SurfaceEdges edges = surface_edges(coarse.triangles);
        for (const auto& e : edges.vertices)
            EXPECT_LT((sheet.points.row(e[0]) - sheet.points.row(e[1])).norm(), 2.0 * wanted);
    }
}

TEST(Decimate, ASizeFieldIsFollowed) {
    const Sheet sheet = dome(48, 0);
    std::vector<double> length;
    for (long v = 0; v < sheet.points.rows(); ++v)
        length.push_back(0.04 + 0.12 * sheet.points(v, 0));
    const Decimated coarse = decimate(sheet.triangles, sheet.points, length, {});
    double fine = 0, rough = 0;
    int fines = 0, roughs = 0;
    const SurfaceEdges edges = surface_edges(coarse.triangles);
    for (const auto& e : edges.vertices) {
        const double x = 0.5 * (sheet.points(e[0], 0) + sheet.points(e[1], 0));
        const double l = (sheet.points.row(e[0]) - sheet.points.row(e[1])).norm();
        if (x < 0.2) fine += l, ++fines;
        if (x > 0.8) rough += l, ++roughs;
    }
    EXPECT_GT(rough / roughs, 1.8 * fine / fines);
}

TEST(Decimate, NoTriangleTurnsOver) {
    const Sheet sheet = dome(40, 0.2);
    const Decimated coarse =
        decimate(sheet.triangles, sheet.points,
                 std::vector<double>(static_cast<std::size_t>(sheet.points.rows()), 0.12), {});
    for (long f = 0; f < coarse.triangles.rows(); ++f) {
        const Vec3 n = normal(sheet.points, coarse.triangles, f);
        EXPECT_GT(n.z(), 0.3 * n.norm()) << f;
        EXPECT_GT(n.norm(), 1e-4);
    }
}

TEST(Decimate, TheOutlineStays) {
    const Sheet sheet = dome(40);
    const Decimated coarse =
        decimate(sheet.triangles, sheet.points,
                 std::vector<double>(static_cast<std::size_t>(sheet.points.rows()), 0.13), {});
    const auto loops = boundary_loops(coarse.triangles, surface_edges(coarse.triangles));
    ASSERT_EQ(loops.size(), 1u);
    // A removed boundary vertex may be up to a quarter of the wanted length away from the new edge.
    double area = 0;
    for (long f = 0; f < coarse.triangles.rows(); ++f)
        area += 0.5 * normal(sheet.points, coarse.triangles, f).z();
    EXPECT_NEAR(area, 1.0, 0.02);
    for (int v : loops[0]) {
        const double x = sheet.points(v, 0), y = sheet.points(v, 1);
        EXPECT_LT(std::min({x, y, 1 - x, 1 - y}), 1e-12) << "an inner vertex came to the outline";
    }
}

TEST(Decimate, ItStaysOneManifoldPiece) {
    const Sheet sheet = dome(40);
    const Decimated coarse =
        decimate(sheet.triangles, sheet.points,
                 std::vector<double>(static_cast<std::size_t>(sheet.points.rows()), 0.1), {});
    const SurfaceEdges edges = surface_edges(coarse.triangles);
    for (int e = 0; e < edges.count(); ++e) EXPECT_LE(edges.triangle_count(e), 2);
    EXPECT_EQ(surface_pieces(coarse.triangles, static_cast<int>(sheet.points.rows())).count(), 1);
    // Euler characteristic of a disc.
    EXPECT_EQ(static_cast<int>(coarse.kept.size()) - edges.count() +
                  static_cast<int>(coarse.triangles.rows()),
              1);
}

TEST(Decimate, EveryVertexKnowsWhereItWent) {
    Sheet sheet = dome(30);
    sheet.points.conservativeResize(sheet.points.rows() + 1, 3);
    sheet.points.row(sheet.points.rows() - 1).setZero();  // on no triangle
    const Decimated coarse =
        decimate(sheet.triangles, sheet.points,
                 std::vector<double>(static_cast<std::size_t>(sheet.points.rows()), 0.1), {});
    const std::set<int> kept(coarse.kept.begin(), coarse.kept.end());
    EXPECT_TRUE(std::is_sorted(coarse.kept.begin(), coarse.kept.end()));
    for (long v = 0; v + 1 < sheet.points.rows(); ++v) {
        ASSERT_TRUE(kept.count(coarse.collapsed_to[v])) << v;
        if (kept.count(static_cast<int>(v))) {
            EXPECT_EQ(coarse.collapsed_to[v], v);
        }
        EXPECT_LT((sheet.points.row(v) - sheet.points.row(coarse.collapsed_to[v])).norm(), 0.3);
    }
    EXPECT_EQ(coarse.collapsed_to.back(), -1);
    std::set<int> used;
    for (long f = 0; f < coarse.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) used.insert(coarse.triangles(f, k));
    EXPECT_EQ(used, kept);
}

TEST(Decimate, WhatIsToBeKeptIsKept) {
    const Sheet sheet = dome(30);
    std::vector<char> keep(static_cast<std::size_t>(sheet.points.rows()), 0);
    for (std::size_t v = 0; v < keep.size(); v += 37) keep[v] = 1;
    const Decimated coarse =
        decimate(sheet.triangles, sheet.points,
                 std::vector<double>(static_cast<std::size_t>(sheet.points.rows()), 0.15), keep);
    const std::set<int> kept(coarse.kept.begin(), coarse.kept.end());
    for (std::size_t v = 0; v < keep.size(); ++v)
        if (keep[v]) {
            EXPECT_TRUE(kept.count(static_cast<int>(v))) << v;
        }
}

TEST(Decimate, NothingIsDoneWhereTheMeshIsAlreadyCoarse) {
    const Sheet sheet = dome(8, 0);
    const Decimated coarse =
        decimate(sheet.triangles, sheet.points,
                 std::vector<double>(static_cast<std::size_t>(sheet.points.rows()), 0.05), {});
    EXPECT_EQ(static_cast<long>(coarse.kept.size()), sheet.points.rows());
    EXPECT_EQ(coarse.triangles.rows(), sheet.triangles.rows());
}

TEST(Decimate, TwiceGivesTheSame) {
    const Sheet sheet = dome(40);
    const std::vector<double> length(static_cast<std::size_t>(sheet.points.rows()), 0.09);
    const Decimated a = decimate(sheet.triangles, sheet.points, length, {}),
                    b = decimate(sheet.triangles, sheet.points, length, {});
    EXPECT_EQ(a.kept, b.kept);
    EXPECT_EQ(a.collapsed_to, b.collapsed_to);
    EXPECT_TRUE(a.triangles == b.triangles);
}

TEST(Decimate, EveryVertexThatIsLeftHasATriangleAlsoOnAnIsland) {
    Sheet sheet = dome(12);
    const auto rows = sheet.points.rows();
    sheet.points.conservativeResize(rows + 4, 3);
    sheet.points.bottomRows(4) << 3, 0, 0, 3.01, 0, 0, 3.01, 0.01, 0, 3, 0.01, 0;
    const int a = static_cast<int>(rows);
    sheet.triangles.conservativeResize(sheet.triangles.rows() + 2, 3);
    sheet.triangles.bottomRows(2) << a, a + 1, a + 2, a, a + 2, a + 3;
    const Decimated coarse =
        decimate(sheet.triangles, sheet.points,
                 std::vector<double>(static_cast<std::size_t>(sheet.points.rows()), 0.3), {});
    const std::set<int> used(coarse.triangles.data(),
                             coarse.triangles.data() + coarse.triangles.size());
    EXPECT_TRUE(used.count(coarse.collapsed_to[static_cast<std::size_t>(a)]));
    for (const int v : coarse.kept) EXPECT_TRUE(used.count(v)) << v;
}

}  // namespace
}  // namespace risorius::geom
