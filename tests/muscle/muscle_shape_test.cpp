// SPDX-License-Identifier: MIT
// Grids of every muscle shape: their volume, lengths and directions, and what is rejected.

#include "risorius/muscle/muscle_shape.h"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "muscle_shapes.h"
#include "risorius/core/error.h"
#include "risorius/geom/closest_point.h"
#include "risorius/tissue/cell_solid.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::muscle {
namespace {

using namespace testing_of;
using tissue::GridShape;

std::string refusal(const std::function<void()>& of) {
    try {
        of();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::string refusal(const MuscleShape& shape, const GridShape& grid = {6, 3, 3}) {
    return refusal([&] { muscle_belly(shape, grid); });
}

TEST(MuscleShape, ABlockHasItsEdgesAndARoundOneTheAreaOfItsPolygon) {
    const Belly block = muscle_belly(block_shape(), {5, 4, 3});
    EXPECT_NEAR(block.volume_m3, 0.04 * 0.02 * 0.01, 1e-18);
    EXPECT_NEAR(block.fibre_length_m.minCoeff(), 0.04, 1e-15);
    EXPECT_EQ(block.rest.row(0), Eigen::RowVector3d(0, -0.01, -0.005));
    MuscleShape cylinder = fusiform_shape();
    cylinder.end_ratio = 1;
    const double area = std::numbers::pi / 4 * 0.02 * 0.016;
    // With three nodes, the circle becomes an octagon.
    const double octagon = 4 * std::sin(std::numbers::pi / 4) / std::numbers::pi;
    EXPECT_NEAR(muscle_belly(cylinder, {5, 3, 3}).volume_m3, 0.04 * area * octagon, 1e-12);
    EXPECT_NEAR(disc_over_polygon(3, 3), 1 / octagon, 1e-12);
    cylinder.equal_volume = true;
    EXPECT_NEAR(muscle_belly(cylinder, {5, 3, 3}).volume_m3, 0.04 * area, 1e-12);
}

TEST(MuscleShape, ASpindleSwellsInTheMiddleAndTapersToItsTendons) {
    const Belly belly = muscle_belly(fusiform_shape(), {7, 3, 3});
    const auto width = [&](int m) {
        return belly.rest(belly.grid.index(m, 2, 1), 1) - belly.rest(belly.grid.index(m, 0, 1), 1);
    };
    EXPECT_NEAR(width(3), 0.02, 1e-15);
    EXPECT_NEAR(width(0), 0.01, 1e-15);
    EXPECT_NEAR(width(6), 0.01, 1e-15);
    for (int m = 0; m < 3; ++m) EXPECT_LT(width(m), width(m + 1));
}

TEST(MuscleShape, ASheetFansOutFromItsInsertion) {
    const Belly belly = muscle_belly(sheet_shape(), {5, 5, 2});
    EXPECT_NEAR(belly.volume_m3, 0.05 * 0.004 * 0.5 * (0.05 + 0.025), 1e-15);
    EXPECT_NEAR(belly.fibre_length_m[4], 0.05, 1e-15);
    EXPECT_NEAR(belly.fibre_length_m[0], std::hypot(0.05, 0.0125), 1e-15);
}

TEST(MuscleShape, ABentMuscleFollowsItsPathWithTheGivenOutwardSide) {
    const Belly belly = muscle_belly(bent_shape(), {13, 3, 3});
    for (int m = 0; m < 13; ++m) {
        const Vec3 middle = belly.rest.row(belly.grid.index(m, 1, 1)),
                   outer = belly.rest.row(belly.grid.index(m, 1, 2));
        EXPECT_NEAR(middle.norm(), 0.04, 4e-5);  // five points make the circle
        EXPECT_NEAR(outer.norm(), 0.043, 4e-5);
    }
    // Outer fibres are longer in proportion to their circle, except for the chords of the slabs.
    const double chord = 24 * std::sin(std::numbers::pi / 48);
    EXPECT_NEAR(belly.fibre_length_m[5], 0.043 * chord, 2e-4);
    EXPECT_NEAR(belly.fibre_length_m[3], 0.037 * chord, 2e-4);
}

TEST(MuscleShape, ARingClosesOnItself) {
    const Belly belly = muscle_belly(ring_shape(), {16, 3, 3});
    EXPECT_TRUE(belly.grid.closed);
    // Pappus: area of the section times the path of its centre. Slabs are oblique by half an angle of the 16-gon.
    const double octagon = 4 * std::sin(std::numbers::pi / 4) / std::numbers::pi;
    const double area =
        octagon * std::numbers::pi / 4 * 0.008 * 0.005 * std::cos(std::numbers::pi / 16);
    EXPECT_NEAR(belly.volume_m3 / (area * belly.fibre_length_m[4]), 1, 0.01);
    EXPECT_NEAR(belly.fibre_length_m[4], 0.1643, 0.002);  // circumference of the oval
    const tissue::CellMesh mesh = tissue::uniform_cells(belly.grid);
    EXPECT_EQ(mesh.node_count(), belly.grid.size());
    EXPECT_EQ(mesh.cells().size(), 16U * 2 * 2);
    Points all = belly.rest;
    double sum = 0;
    for (const tissue::CellMesh::Cell& cell : mesh.cells()) sum += tissue::cell_volume(cell, all);
    EXPECT_NEAR(sum / belly.volume_m3, 1, 1e-12);
    // Width is in the plane, and its far side inside the ring. Thickness is perpendicular to the plane.
    for (int m = 0; m < 16; ++m) {
        const Vec3 inner = belly.rest.row(belly.grid.index(m, 2, 1)),
                   outer = belly.rest.row(belly.grid.index(m, 0, 1)),
                   front = belly.rest.row(belly.grid.index(m, 1, 2));
        EXPECT_NEAR(outer.norm() - inner.norm(), 0.008, 5e-4);
        EXPECT_NEAR(front.z(), 0.0025, 1e-12);
    }
    // Four faces, each a band.
    EXPECT_EQ(tissue::surface_triangles(belly.grid).rows(), 2 * 16 * 8);
}

TEST(MuscleShape, AFramedPathInSpaceTurnsNoMoreThanItHasTo) {
    // Along a helix without a given outward direction, neighbouring sections are not rotated relative to each other.
    MuscleShape helix = bent_shape();
    helix.outward.resize(0, 3);
    helix.widths_m = {0.006};
    helix.path_m.resize(17, 3);
    for (int i = 0; i < 17; ++i)
        helix.path_m.row(i) << 0.02 * std::cos(0.4 * i), 0.02 * std::sin(0.4 * i), 0.01 * i;
    const Belly belly = muscle_belly(helix, {60, 3, 3});
    for (int m = 0; m + 1 < 60; ++m) {
        const auto node = [&](int i, int j, int k) {
            return Vec3(belly.rest.row(belly.grid.index(i, j, k)));
        };
        const Vec3 a = (node(m, 2, 1) - node(m, 0, 1)).normalized(),
                   n = (node(m, 1, 2) - node(m, 1, 0)).normalized(),
                   b = (node(m + 1, 2, 1) - node(m + 1, 0, 1)).normalized();
        EXPECT_NEAR(b.dot(n), 0, 2e-3) << m;
        EXPECT_GT(b.dot(a), 0.95);
    }
}

TEST(MuscleShape, AClosedSurfaceIsFilledAlongItsMiddleLineWithItsVolume) {
    for (const double bend : {0.0, 1.2, 2.4}) {
        MuscleShape shape = spindle_shape(bend);
        const double volume = surface_volume(shape);
        const Belly belly = muscle_belly(shape, {9, 5, 5});
        EXPECT_NEAR(belly.volume_m3 / volume, 1, 1e-6) << bend;
        // Of 60 mm, 2 % are left out at either tip.
        EXPECT_NEAR(belly.fibre_length_m[12], 0.96 * 0.06, 0.001) << bend;
        // Width is in the direction in which the body is widest.
        const Vec3 width =
            belly.rest.row(belly.grid.index(4, 4, 2)) - belly.rest.row(belly.grid.index(4, 0, 2));
        EXPECT_GT(std::abs(width.normalized().y()), 0.99) << bend;

        shape.equal_volume = false;
        const Belly inside = muscle_belly(shape, {13, 9, 9});
        // Blunt tips, polygonal sections and straight sides all reduce the volume.
        EXPECT_NEAR(inside.volume_m3 / volume, 1, 0.035) << bend;
        EXPECT_LT(inside.volume_m3, volume);
        const geom::SurfaceTree tree(shape.surface_m, shape.triangles);
        for (int m = 0; m < 13; ++m)
            for (int k = 0; k < 9; ++k) {
                const Vec3 p = inside.rest.row(inside.grid.index(m, 0, k));
                EXPECT_LT(std::sqrt(tree.closest(p)->squared_distance), 1e-12);
            }
    }
}

TEST(MuscleShape, ASurfaceMayLieAnywhereAndGivesTheSameGrid) {
    const MuscleShape shape = spindle_shape(1.2);
    MuscleShape moved = shape;
    const Rigid motion = Eigen::Translation3d(0.3, -0.2, 1) *
                         Eigen::AngleAxisd(0.6, Vec3(1, -0.3, 0.4).normalized());
    moved.surface_m = (shape.surface_m * motion.linear().transpose()).rowwise() +
                      motion.translation().transpose();
    const Points rest = muscle_belly(shape, {7, 4, 4}).rest,
                 far = muscle_belly(moved, {7, 4, 4}).rest;
    const Points back =
        (rest * motion.linear().transpose()).rowwise() + motion.translation().transpose();
    EXPECT_LT((far - back).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(MuscleShape, SizesThatAreNotPositiveAreRefusedByName) {
    MuscleShape shape = block_shape();
    shape.width_m = 0;
    EXPECT_EQ(refusal(shape), "block/width_m: expected (0, inf), found 0");
    shape = fusiform_shape();
    shape.end_ratio = 1.2;
    EXPECT_EQ(refusal(shape), "round/end_ratio: expected (0, 1], found 1.2");
    shape = sheet_shape();
    shape.insertion_width_m = std::nan("");
    EXPECT_EQ(refusal(shape), "sheet/insertion_width_m: expected (0, inf), found nan");
    shape = bent_shape();
    shape.widths_m[2] = -1;
    EXPECT_EQ(refusal(shape), "path/width_m/2: expected (0, inf), found -1");
    shape = bent_shape();
    shape.thicknesses_m = {0.006, 0.006};
    EXPECT_EQ(refusal(shape),
              "path/thickness_m: expected one number, or one per point of the path, found 2");
    EXPECT_EQ(refusal(ring_shape(), {2, 2, 2}),
              "ring: expected a grid of at least 3 x 2 x 2 nodes, found 2 x 2 x 2");
}

TEST(MuscleShape, PathsThatFoldTheirSectionsAreRefused) {
    MuscleShape shape = bent_shape();
    shape.path_m.row(3) = shape.path_m.row(2);
    EXPECT_EQ(refusal(shape),
              "path/path_m/3: expected a point apart from its neighbours, found the same place "
              "twice");
    shape = bent_shape();
    shape.path_m(1, 1) = std::nan("");
    EXPECT_EQ(refusal(shape), "path/path_m/1: expected three finite numbers, found others");
    shape = bent_shape();
    shape.outward.setZero(1, 3);
    shape.outward(0, 0) = 1;
    EXPECT_EQ(refusal(shape).rfind("path/outward/0: expected a direction across the path", 0), 0U)
        << refusal(shape);
    shape = bent_shape();
    shape.thicknesses_m = {0.09};
    EXPECT_EQ(refusal(shape),
              "path/path_m: expected bends wider than the section is deep on their inner side, "
              "found a radius of 44.9 mm against 45 mm at 4 % of the length");
}

TEST(MuscleShape, SurfacesThatCannotBeFilledAreRefused) {
    MuscleShape open = spindle_shape(0);
    open.triangles.conservativeResize(open.triangles.rows() - 1, 3);
    EXPECT_EQ(refusal(open),
              "surface/triangles: expected a closed surface: two triangles at every edge, found 1 "
              "at the edge of points 552 and 575");
    MuscleShape inward = spindle_shape(0);
    inward.triangles.col(0).swap(inward.triangles.col(1));
    EXPECT_EQ(refusal(inward),
              "surface/triangles: expected a surface turned outward, found one turned inward");
    MuscleShape mixed = spindle_shape(0);
    std::swap(mixed.triangles(3, 0), mixed.triangles(3, 1));
    EXPECT_EQ(refusal(mixed).rfind(
                  "surface/triangles: expected neighbours turned to the same side, found", 0),
              0U);
    MuscleShape two = spindle_shape(0);
    const Eigen::Index points = two.surface_m.rows(), faces = two.triangles.rows();
    two.surface_m.conservativeResize(2 * points, 3);
    two.surface_m.bottomRows(points) = two.surface_m.topRows(points).array() + 0.1;
    two.triangles.conservativeResize(2 * faces, 3);
    two.triangles.bottomRows(faces) =
        two.triangles.topRows(faces).array() + static_cast<int>(points);
    EXPECT_EQ(refusal(two), "surface/triangles: expected a surface of one piece, found 2");
    // Mirrored over a part of its circumference, a section intersects itself.
    MuscleShape twisted = spindle_shape(0);
    for (Eigen::Index i = 0; i < points - 2; ++i)
        if (i % 24 >= 4 && i % 24 <= 8) twisted.surface_m(i, 2) *= -1;
    EXPECT_EQ(refusal(twisted).rfind("surface: expected sections that do not cross themselves", 0),
              0U)
        << refusal(twisted);
    // A ball has the same length in every direction.
    MuscleShape ball = spindle_shape(0);
    for (Eigen::Index i = 0; i < points; ++i) {
        Vec3 p = ball.surface_m.row(i);
        p = p.cwiseQuotient(Vec3(0.03, 0.01, 0.007));
        ball.surface_m.row(i) = 0.01 * p.normalized().transpose();
    }
    EXPECT_EQ(refusal(ball),
              "surface: expected \"path_m\" for a body without a long axis, found none");
}

TEST(MuscleShape, ShapesAreReadFromJson) {
    const auto read = [](const char* json) {
        return read_muscle_shape(
            JsonCursor::from_json({{"shape", Json::parse(json)}}, "head.json").at("shape"));
    };
    EXPECT_EQ(read(R"({"block_m": [0.05, 0.02, 0.01]})").thickness_m, 0.01);
    const MuscleShape round = read(
        R"({"round": {"length_m": 0.1, "width_m": 0.03, "thickness_m": 0.02, "end_ratio": 0.4}})");
    EXPECT_EQ(round.end_ratio, 0.4);
    EXPECT_EQ(round.place, "head.json:/shape/round");
    EXPECT_EQ(
        read(R"({"sheet": {"length_m": 0.06, "origin_width_m": 0.08, "insertion_width_m": 0.02,
                       "thickness_m": 0.004}})")
            .insertion_width_m,
        0.02);
    const MuscleShape ring = read(R"({"ring": {"path_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
        "outward": [[0, 0, 1]], "width_m": [0.1, 0.1, 0.2], "thickness_m": 0.1, "section": "block",
        "equal_volume": true}})");
    EXPECT_EQ(ring.form, MuscleShape::Form::kRing);
    EXPECT_EQ(ring.section, MuscleShape::Section::kBlock);
    EXPECT_EQ(ring.widths_m[2], 0.2);
    EXPECT_TRUE(ring.equal_volume);
    const MuscleShape surface = read(R"({"surface": {"points_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0],
        [0, 0, 1]], "triangles": [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        "path_m": [[0, 0, 0], [0.2, 0.2, 0.3]]}})");
    EXPECT_EQ(surface.triangles(3, 2), 3);
    EXPECT_EQ(refusal([&] { read("{}"); }), "head.json:/shape: expected one shape, found none");
    EXPECT_EQ(refusal([&] { read(R"({"block_m": [0.05, 0, 0.01]})"); }),
              "head.json:/shape/block_m/1: expected a number in (0, inf), found 0");
    EXPECT_EQ(refusal([&] { read(R"({"ring": {"path_m": [], "width_m": [1, -2]}})"); }),
              "head.json:/shape/ring/width_m/1: expected a number in (0, inf), found -2");
}

}  // namespace
}  // namespace risorius::muscle
