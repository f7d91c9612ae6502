// SPDX-License-Identifier: MIT
// Skin of fewer triangles for small pictures: near to what it stands for, with the same rim and what must stay.
#include "risorius/render/detail/coarser_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr int kSide = 41;

/// A bulging sheet of 10 x 10 cm, as a cheek is.
struct Sheet {
    Points rest{kSide * kSide, 3};
    std::vector<Face> faces;
    Sheet() {
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i) {
                const double x = 0.1 * i / (kSide - 1) - 0.05, y = 0.1 * j / (kSide - 1) - 0.05;
                rest.row(j * kSide + i) << x, y, 0.02 * std::cos(30 * x) * std::cos(20 * y);
            }
        for (int j = 0; j + 1 < kSide; ++j)
            for (int i = 0; i + 1 < kSide; ++i) {
                const int a = j * kSide + i;
                faces.push_back({a, a + 1, a + kSide});
                faces.push_back({a + 1, a + kSide + 1, a + kSide});
            }
    }
};

/// Of a height field: the height of the faces over (x, y).
double height(const Points& rest, const std::vector<Face>& faces, double x, double y) {
    for (const Face& face : faces) {
        const Vec3 a = rest.row(face[0]), b = rest.row(face[1]), c = rest.row(face[2]);
        const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
        const double v = ((x - a.x()) * (c.y() - a.y()) - (y - a.y()) * (c.x() - a.x())) / area;
        const double w = ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x())) / area;
        if (v > -1e-9 && w > -1e-9 && v + w < 1 + 1e-9)
            return a.z() + v * (b.z() - a.z()) + w * (c.z() - a.z());
    }
    return std::nan("");
}

TEST(CoarserFaces, AreFewerAndNearTheGivenOnes) {
    const Sheet sheet;
    const auto none = [](const Face&) { return false; };
    std::size_t before = sheet.faces.size();
    for (const double error_m : {0.05e-3, 0.2e-3, 0.8e-3}) {
        const std::vector<Face> fewer = coarser_faces(sheet.rest, sheet.faces, error_m, none);
        EXPECT_LT(fewer.size(), before);
        before = fewer.size();
        double farthest = 0;
        for (Eigen::Index v = 0; v < sheet.rest.rows(); ++v)
            farthest = std::max(
                farthest, std::abs(height(sheet.rest, fewer, sheet.rest(v, 0), sheet.rest(v, 1)) -
                                   sheet.rest(v, 2)));
        EXPECT_LT(farthest,
                  3 * error_m);  // quadrics tell a mean of distances; no place is uncovered
    }
    EXPECT_LT(before, sheet.faces.size() / 8);
}

TEST(CoarserFaces, WhatStaysStaysWithoutCracks) {
    const Sheet sheet;
    const auto in_the_middle = [&](const Face& face) {
        return std::any_of(face.begin(), face.end(),
                           [&](int v) { return sheet.rest.row(v).head<2>().norm() < 0.015; });
    };
    const std::vector<Face> fewer = coarser_faces(sheet.rest, sheet.faces, 0.5e-3, in_the_middle);
    const std::set<Face> all(fewer.begin(), fewer.end());
    for (const Face& face : sheet.faces) EXPECT_TRUE(!in_the_middle(face) || all.contains(face));
    // Every side of a face but the sheet's own rim has a face beyond it
    std::multiset<std::pair<int, int>> sides;
    for (const Face& face : fewer)
        for (std::size_t k = 0; k < 3; ++k) sides.insert({face[k], face[(k + 1) % 3]});
    const auto on_rim = [](int v) {
        return v % kSide == 0 || v % kSide == kSide - 1 || v < kSide || v >= kSide * (kSide - 1);
    };
    for (const auto& [a, b] : sides) {
        EXPECT_EQ(sides.count({a, b}), 1U);
        EXPECT_TRUE(sides.contains({b, a}) || (on_rim(a) && on_rim(b)));
    }
}

TEST(CoarserFaces, AreTheSameWithoutAnErrorOrAMouth) {
    const Sheet sheet;
    EXPECT_EQ(coarser_faces(sheet.rest, sheet.faces, 0, [](const Face&) { return false; }),
              sheet.faces);
    Scene scene;
    scene.rest = sheet.rest;
    EXPECT_EQ(coarser_faces(sheet.rest, sheet.faces, 1e-3, much_moved(scene)), sheet.faces);
}

TEST(CoarserFaces, SkinThatMayWrinkleIsToldOnlyWhenWanted) {
    const Sheet sheet;
    Scene scene;
    scene.rest = sheet.rest;
    EXPECT_FALSE(may_fold(scene, true)(sheet.faces[0]));
    scene.fold_phase = Points::Zero(sheet.rest.rows(), 3);
    scene.fold_phase(sheet.faces[0][1], 2) = 0.5;
    EXPECT_TRUE(may_fold(scene, true)(sheet.faces[0]));
    EXPECT_FALSE(may_fold(scene, true)(sheet.faces.back()));
    EXPECT_FALSE(may_fold(scene, false)(sheet.faces[0]));
}

TEST(SkinRelief, WithoutPoresTheirMapIsNotLookedUp) {
    EXPECT_NE(skin_layer_shader({.pores = true}).find("pore_map"), std::string::npos);
    EXPECT_EQ(skin_layer_shader({.pores = false}).find("pore_map"), std::string::npos);
}

}  // namespace
}  // namespace risorius::render
