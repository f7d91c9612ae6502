// SPDX-License-Identifier: MIT
// Solids on meshes finer than their description: the same part is held, and the boundary is closed.
#include "risorius/softbody/refined_body.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "risorius/tissue/refine.h"

namespace risorius::softbody {
namespace {

BodyDescription block() {
    return read_body(JsonCursor::from_json(Json::parse(R"({
        "kind": "solid", "discretisation": "cells", "grid": [5, 4, 3],
        "rest": {"block_m": [4, 3, 2]},
        "material": {"mass_kg": 4, "elastic_n_per_m3": 1.5, "incompressibility_n_per_m5": 10},
        "fixed": [{"a3": "first"}, {"a1": [1, 2], "a3": "last"}]})"),
                                           "block.json"));
}

/// Every root cell at a1 = 0 is split, and one of them twice.
std::shared_ptr<tissue::CellSolid> refined(const BodyDescription& description) {
    tissue::AdaptiveSolid solid(grid_solid(description), {.deepest_level = 2});
    solid.refine_where([](const tissue::CellMesh::Cell& cell) {
        return cell.low[0] == 0 && (cell.place.level == 0 || cell.low.maxCoeff() == 0);
    });
    return solid.solid();
}

TEST(RefinedBody, TheSamePartIsHeldOnEveryMesh) {
    const BodyDescription description = block();
    const auto solid = refined(description);
    const std::vector<char> held = held_nodes(description.fixed, solid->mesh());
    int beyond_root = 0;
    for (int i = 0; i < solid->mesh().node_count(); ++i) {
        const auto a = solid->mesh().material_coordinates().row(i);
        const bool expected = a[2] == 0 || (a[2] == 1 && a[0] >= 0.25 && a[0] <= 0.5);
        EXPECT_EQ(held[static_cast<std::size_t>(i)] != 0, expected) << a;
        if (expected && std::abs(4 * a[0] - std::round(4 * a[0])) > 1e-9) ++beyond_root;
    }
    EXPECT_GT(beyond_root, 0);
    const solve::MotionSystem system = refined_system(description, solid, {});
    EXPECT_EQ(system.fixed(), held);
    EXPECT_NEAR(system.mass_kg().sum(), 4, 1e-12);
}

TEST(RefinedBody, BoundaryEnclosesTheVolumeAndEndsHaveTheirCentres) {
    const BodyDescription description = block();
    const auto solid = refined(description);
    Points x = solid->body().rest;
    for (Eigen::Index i = 0; i < x.rows(); ++i)  // linear: hanging vertices lie on flat faces
        x.row(i) << 1.1 * x(i, 0) + 0.2 * x(i, 2), x(i, 1), x(i, 2) - 0.1 * x(i, 0);
    const CellBoundary boundary = boundary_of(solid->mesh());
    const Points vertices = solid->vertices(x);
    double volume = 0;
    for (Eigen::Index t = 0; t < boundary.surface.rows(); ++t) {
        const auto corner = [&](int k) {
            return Vec3(vertices.row(boundary.surface(t, k)).transpose());
        };
        volume += corner(0).cross(corner(1)).dot(corner(2)) / 6;
    }
    EXPECT_NEAR(volume, solid->volume(x), 1e-12 * volume) << "outward";
    EXPECT_GT(volume, 0);
    EXPECT_FALSE(boundary.wires.empty());
    // In the rest shape, the end a1 = 0 has cells of two sizes, and its centre is the middle of 3 x 2.
    EXPECT_LT((face_centre(*solid, solid->body().rest, 0, false) - Vec3(0, 1.5, 1)).norm(), 1e-12);
    EXPECT_LT((face_centre(*solid, solid->body().rest, 1, true) - Vec3(2, 3, 1)).norm(), 1e-12);
}

TEST(RefinedBody, WhatCannotBeRefinedIsNamed) {
    const auto message = [](const char* key, const char* value) -> std::string {
        Json json = Json::parse(R"({"kind": "solid", "discretisation": "cells", "grid": [3, 3, 3],
            "rest": {"block_m": [1, 1, 1]}, "material": {"mass_kg": 1, "elastic_n_per_m3": 1}})");
        json[key] = value;
        try {
            check_refinable(
                read_body(JsonCursor::from_json(Json{{"body", json}}, "mine.json").at("body")));
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(message("discretisation", "differences"),
              "mine.json:/body/discretisation: expected \"cells\", which can be refined, found "
              "\"differences\"");
    EXPECT_EQ(message("discretisation", "cells"), "accepted");
}

}  // namespace
}  // namespace risorius::softbody
