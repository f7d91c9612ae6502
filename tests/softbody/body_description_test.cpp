// SPDX-License-Identifier: MIT
// What a person reads when the description of a soft body is wrong, and the meaning of a right one. Whole messages are
// compared.
#include "risorius/softbody/body_description.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/softbody/soft_body.h"

namespace risorius::softbody {
namespace {

Json cube() {
    return Json::parse(R"({
        "kind": "solid", "discretisation": "differences", "grid": [4, 4, 4],
        "rest": {"block_m": [3, 3, 3]},
        "material": {"mass_kg": 4, "elastic_n_per_m3": 1.5, "damping_ns_per_m3": 0.1,
                     "incompressibility_n_per_m5": 10},
        "fixed": [{"a3": "last"}]})");
}

BodyDescription read(const Json& json) {
    return read_body(JsonCursor::from_json(Json{{"body", json}}, "cube.json").at("body"));
}

/// The message of reading a body with one changed value.
std::string message_with(const char* pointer, const char* value, Json json = cube()) {
    json[Json::json_pointer(pointer)] = Json::parse(value);
    return message_of([&] { read(json); });
}

TEST(BodyDescription, ACubeIsReadAsWritten) {
    const BodyDescription body = read(cube());
    EXPECT_EQ(body.grid.size(), 64);
    EXPECT_EQ(body.discretisation, Discretisation::kDifferences);
    EXPECT_EQ(body.material.mass_kg, 4);
    EXPECT_EQ(body.material.elastic_n_per_m3, Mat3::Constant(1.5));
    EXPECT_EQ(body.gravity_m_per_s2, Vec3(0, 0, -9.81));
    const std::vector<char> fixed = fixed_flags(body);
    for (int node = 0; node < 64; ++node)
        EXPECT_EQ(fixed[static_cast<std::size_t>(node)] != 0, node % 4 == 3) << node;
    const tissue::GridSolid solid = grid_solid(body);
    EXPECT_EQ(solid.rest.row(63), Eigen::RowVector3d(3, 3, 3));
    EXPECT_EQ(solid.material.size(), 1u);
}

TEST(BodyDescription, BadNumbersAreNamedWithTheirPlace) {
    EXPECT_EQ(message_with("/material/mass_kg", "-4"),
              "cube.json:/body/material/mass_kg: expected a number in (0, inf), found -4");
    EXPECT_EQ(message_with("/material/mass_kg", "0"),
              "cube.json:/body/material/mass_kg: expected a number in (0, inf), found 0");
    EXPECT_EQ(message_with("/material/mass_kg", "null"),
              "cube.json:/body/material/mass_kg: expected a number in (0, inf), found null");
    EXPECT_EQ(message_with("/material/elastic_n_per_m3", "\"NaN\""),
              "cube.json:/body/material/elastic_n_per_m3: expected a number or an object like "
              "{\"11\": 1, \"12\": 0.5}, found \"NaN\"");
    EXPECT_EQ(message_with("/material/elastic_n_per_m3", "-1.5"),
              "cube.json:/body/material/elastic_n_per_m3: expected [0, inf), found -1.5");
    EXPECT_EQ(message_with("/material/incompressibility_n_per_m5", "-10"),
              "cube.json:/body/material/incompressibility_n_per_m5: expected [0, inf), found -10");
    EXPECT_EQ(message_with("/grid/1", "1"),
              "cube.json:/body/grid/1: expected an integer in [2, 1000], found 1");
    EXPECT_EQ(message_with("/grid", "[4, 4]"),
              "cube.json:/body/grid: expected three numbers of nodes, one per axis, found [4,4]");
    EXPECT_EQ(message_with("/rest/block_m/2", "0"),
              "cube.json:/body/rest/block_m/2: expected a number in (0, inf), found 0");
    EXPECT_EQ(message_with("/gravity_m_per_s2", "[0, \"down\", 0]"),
              "cube.json:/body/gravity_m_per_s2/1: expected a number, found \"down\"");
    EXPECT_EQ(
        message_with("/kind", "\"gas\""),
        "cube.json:/body/kind: expected one of \"solid\" \"surface\" \"cylinder\" \"curve\", found "
        "\"gas\"");
}

TEST(BodyDescription, UnknownAndMissingKeysAreNamed) {
    EXPECT_EQ(message_with("/material/mass_kq", "4"),
              "cube.json:/body/material/mass_kq: expected a known key (did you mean \"mass_kg\"?), "
              "found unknown key \"mass_kq\"");
    Json json = cube();
    json.erase("rest");
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body: expected the key \"rest\", found none");
    json = cube();
    json["rest"] = Json::object();
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/rest: expected one of \"block_m\", \"cylinder\" and \"points_m\", "
              "found none");
}

TEST(BodyDescription, FoldedRestShapesAreRefused) {
    Json json = cube();
    json["grid"] = {2, 2, 2};
    Json points = Json::array();
    // Mirrored: left-handed.
    for (int i : {0, 1})
        for (int j : {0, 1})
            for (int k : {0, 1}) points.push_back({-i, j, k});
    json["rest"] = {{"points_m", points}};
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/rest: expected a shape that is nowhere folded, with a positive "
              "volume in each corner of every cell, found -1 m^3 in cell [0, 0, 0]");
    points.erase(0);
    json["rest"] = {{"points_m", points}};
    EXPECT_EQ(
        message_of([&] { read(json); }),
        "cube.json:/body/rest/points_m: expected 8 points, one per node of the grid, found 7");
}

TEST(BodyDescription, NodesThatTheGridDoesNotHaveAreNamed) {
    EXPECT_EQ(message_with("/fixed/0/a3", "4"),
              "cube.json:/body/fixed/0/a3: expected an index in [-4, 3] of this grid, found 4");
    EXPECT_EQ(message_with("/fixed/0/a3", "\"top\""),
              "cube.json:/body/fixed/0/a3: expected \"first\", \"last\", an index, [index, index] "
              "or {\"from\": 0..1, \"to\": 0..1}, found \"top\"");
    EXPECT_EQ(message_with("/fixed/0", "{}"),
              "cube.json:/body/fixed/0: expected nodes named by axes or corners, found none");
    EXPECT_EQ(message_with("/fixed/0", "{\"a4\": 0}"),
              "cube.json:/body/fixed/0/a4: expected a known key (did you mean \"a1\"?), found "
              "unknown key \"a4\"");
}

TEST(BodyDescription, NothingNeedsToBeFixed) {
    Json json = cube();
    json.erase("fixed");
    for (const char flag : fixed_flags(read(json))) EXPECT_EQ(flag, 0);
}

TEST(BodyDescription, RegionsChangeOnlyTheirNodesAndEntries) {
    Json json = cube();
    json["regions"] = Json::parse(R"([
        {"nodes": {"a1": {"from": 0.3, "to": 0.7}}, "factors": {"elastic": {"22": 0.5, "23": 0.1}}},
        {"nodes": {"a1": "first"}, "values": {"mass_kg": 8}}])");
    const tissue::GridSolid solid = grid_solid(read(json));
    for (int node = 0; node < 64; ++node) {
        const tissue::SolidMaterial& material = solid.material[static_cast<std::size_t>(node)];
        const int plane = node / 16;
        const bool middle = plane == 1 || plane == 2;
        EXPECT_EQ(material.elastic_n_per_m3(1, 1), middle ? 0.75 : 1.5);
        EXPECT_DOUBLE_EQ(material.elastic_n_per_m3(1, 2), middle ? 1.5 * 0.1 : 1.5);
        EXPECT_DOUBLE_EQ(material.elastic_n_per_m3(2, 1), middle ? 1.5 * 0.1 : 1.5);
        EXPECT_EQ(material.elastic_n_per_m3(0, 0), 1.5);
        EXPECT_EQ(material.mass_kg, plane == 0 ? 8 : 4);
    }
    EXPECT_EQ(
        message_with("/regions", R"([{"nodes": {"a1": 0}, "factors": {"elastic": {"44": 1}}}])")
            .substr(0, 58),
        "cube.json:/body/regions/0/factors/elastic/44: expected a k");
    EXPECT_EQ(message_with("/regions", R"([{"nodes": {"a1": 0}, "factors": {"mass": 0}}])"),
              "cube.json:/body/material/0/mass_kg: expected (0, inf), found 0");
}

TEST(BodyDescription, GradedRegionsGrowLinearly) {
    Json json = cube();
    json["regions"] = Json::parse(R"([
        {"nodes": {"a2": {"from": 1, "to": 0}}, "factors": {"elastic": 0.4}, "graded": "a2"}])");
    const tissue::GridSolid solid = grid_solid(read(json));
    for (int plane = 0; plane < 4; ++plane)
        EXPECT_NEAR(solid.material[static_cast<std::size_t>(plane) * 4].elastic_n_per_m3(0, 0),
                    1.5 * (1 - 0.6 * (3 - plane) / 3.0), 1e-12);
    json["regions"][0]["graded"] = "a1";
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/regions/0/graded: expected an axis that \"nodes\" gives a range of, "
              "found \"a1\"");
}

TEST(BodyDescription, CornersReachAlongTheEdges) {
    const NodeSelection selection = read_node_selection(
        JsonCursor::from_json(Json::parse(R"({"corners": [[0, 0], [1, 0], [0, 1]], "reach": 1})"),
                              "cloth.json"),
        2);
    // Figure 8a holds three corners, with three nodes each.
    const std::vector<int> nodes = select(selection, {.m = 13, .n = 13, .o = 1});
    EXPECT_EQ(nodes, (std::vector<int>{0, 1, 11, 12, 13, 25, 143, 156, 157}));
}

TEST(BodyDescription, TensorsTakeTheMeanOfTheirDiagonals) {
    const auto tensor = [](const char* text) {
        return read_tensor(JsonCursor::from_json(Json::parse(text), "tensor.json"), 3);
    };
    Mat3 expected;
    expected << 1, 2, 7, 2, 3, 4, 7, 4, 5;
    EXPECT_EQ(tensor(R"({"11": 1, "22": 3, "33": 5, "13": 7})"), expected);
    EXPECT_EQ(message_of([&] { tensor(R"({"11": 1, "22": 3})"); }),
              "tensor.json:/: expected the diagonal entry \"33\", found none");
    EXPECT_EQ(message_of([&] { tensor(R"({"11": 1, "22": 3, "33": 5, "12": 1, "21": 2})"); }),
              "tensor.json:/21: expected the same number as in \"12\", the tensor being symmetric, "
              "found 2");
}

Json sheet() {
    return Json::parse(R"({
        "kind": "surface", "grid": [5, 5], "rest": {"sheet_m": [3, 3]},
        "material": {"mass_kg": 4, "elastic_n_per_m3": 2, "bending_n_per_m": 0.01},
        "fixed": [{"a2": "first"}]})");
}

TEST(BodyDescription, ASurfaceOnTrianglesKeepsItsNodesItsMassAndWhatHoldsIt) {
    Json json = sheet();
    const SoftBody grid = build_body(read(json));
    json["discretisation"] = "triangles";
    const SoftBody regular = build_body(read(json));
    EXPECT_EQ(regular.rest, grid.rest);
    json["irregular"] = {{"share", 0.4}, {"seed", 7}};
    const SoftBody irregular = build_body(read(json));
    EXPECT_NE(irregular.rest, grid.rest);
    for (const SoftBody* body : {&regular, &irregular}) {
        EXPECT_EQ(body->fixed, grid.fixed);
        EXPECT_EQ(body->edges, grid.edges);
        EXPECT_NEAR(body->weight_n, grid.weight_n, 1e-12);
        EXPECT_EQ(body->surface.rows(), 32);
        EXPECT_EQ(body->wires.size(), 56u) << "V - E + F = 1 for a disc";
    }
    EXPECT_EQ(grid.edges.size(), 16u) << "the border of a sheet";
    EXPECT_EQ(build_body(read(cube())).edges.size(), 36u) << "12 edges of 3 links";
}

TEST(BodyDescription, WhatTrianglesDoNotKnowIsRefused) {
    Json json = sheet();
    json["irregular"] = {{"share", 0.4}};
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/irregular: expected \"triangles\" for its discretisation, found "
              "another");
    json["discretisation"] = "triangles";
    json["irregular"]["share"] = 0.6;
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/irregular/share: expected [0, 0.45], found 0.6");
    json["irregular"]["share"] = 0.4;
    json["springs"] = Json::array();
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/springs: expected none on irregular triangles, found []");
    json = sheet();
    json["discretisation"] = "cells";
    EXPECT_EQ(
        message_of([&] { read(json); }),
        "cube.json:/body/discretisation: expected one of \"differences\" \"triangles\", found "
        "\"cells\"");
}

TEST(BodyDescription, ACurveLiesEvenlyAlongItsPath) {
    Json json = Json::parse(R"({
        "kind": "curve", "grid": [6], "rest": {"path_m": [[0, 0, 0], [0.3, 0, -0.4], [0.6, 0, 0]]},
        "material": {"mass_kg": 2, "elastic_n_per_m3": 100, "bending_n_per_m": 0.5},
        "regions": [{"nodes": {"a1": "last"}, "factors": {"bending": 0.1, "mass": 2}}],
        "fixed": [{"a1": "first"}],
        "springs": [{"at": [0.5], "tied_to_m": [0, 0, 1], "stiffness_n_per_m": 10}]})");
    const SoftBody body = build_body(read(json));
    EXPECT_NEAR((body.rest.row(1) - Eigen::RowVector3d(0.12, 0, -0.16)).norm(), 0, 1e-15);
    EXPECT_NEAR((body.rest.row(5) - Eigen::RowVector3d(0.6, 0, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR(body.weight_n, 9.81 * (2 + 2.0 / 6), 1e-12);
    EXPECT_EQ(body.fixed, std::vector<int>{0});
    EXPECT_EQ(body.wires.size(), 5u);
    EXPECT_EQ(body.edges, body.wires);
    // The spring pulls equally on the two nodes beside the middle: 10 N/m, from the middle to (0, 0, 1).
    Points with, without;
    body.system.force(0, body.rest, Points::Zero(6, 3), with);
    json.erase("springs");
    build_body(read(json)).system.force(0, body.rest, Points::Zero(6, 3), without);
    const Points pull = with - without;
    const Vec3 middle = 0.5 * (body.rest.row(2) + body.rest.row(3)).transpose();
    for (const int node : {2, 3})
        EXPECT_NEAR((pull.row(node).transpose() - 5 * (Vec3(0, 0, 1) - middle)).norm(), 0, 1e-9);
    EXPECT_NEAR(pull.row(1).norm() + pull.row(4).norm(), 0, 1e-12);

    json["grid"] = {6, 6};
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/grid: expected one number of nodes, found [6,6]");
    json["grid"] = {6};
    json["rest"] = Json::parse(R"({"path_m": [[0, 0, 0], [1, 0, 0], [1, 0, 0]]})");
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/rest/path_m/2: expected a point apart from the one before, found "
              "[1,0,0]");
    json["rest"] = Json::parse(R"({"path_m": [[0, 0, 0], [3, 0, 0], [1, 0, 0]]})");
    EXPECT_EQ(
        message_of([&] { read(json); }),
        "cube.json:/body/rest/4: expected a shape without folds, found a link turning back on "
        "the one before");
}

TEST(BodyDescription, ModuliBecomeTheParametersOfTheBlock) {
    Json json = cube();
    json["rest"]["block_m"] = {1, 2, 3};
    json["material"] = {{"shear_pa", 600}, {"bulk_pa", 1600}, {"density_kg_per_m3", 10}};
    // The volume term has K = B - 2 mu / 3; differences count it once per cell.
    const tissue::SolidMaterial material = grid_solid(read(json)).material.front();
    EXPECT_DOUBLE_EQ(material.elastic_n_per_m3(0, 1), 600 * 6 / (1.0 * 4));
    EXPECT_DOUBLE_EQ(material.elastic_n_per_m3(2, 2), 600 * 6 / 81.0);
    EXPECT_NEAR(material.incompressibility_n_per_m5, 1200 / 12.0 / 27, 1e-12);
    EXPECT_DOUBLE_EQ(material.mass_kg, 60);
    json["discretisation"] = "cells";
    EXPECT_NEAR(grid_solid(read(json)).material.front().incompressibility_n_per_m5, 1200 / 12.0,
                1e-12);

    // nu = K / (2 (K + mu)), E = 2 mu (1 + nu)
    json["material"].erase("shear_pa");
    json["material"].erase("bulk_pa");
    json["material"]["poisson_ratio"] = 1200 / (2 * 1800.0);
    json["material"]["young_pa"] = 1200 * (1 + 1200 / (2 * 1800.0));
    EXPECT_NEAR(grid_solid(read(json)).material.front().elastic_n_per_m3(0, 1), 900, 1e-9);

    json["material"]["poisson_ratio"] = 0.5;
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/material/poisson_ratio: expected a number in [0, 0.5), found 0.5");
    json["material"]["shear_pa"] = 600;
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/material: expected either \"shear_pa\" and \"bulk_pa\" or "
              "\"young_pa\" and \"poisson_ratio\", found both");
    json["material"].erase("young_pa");
    json["material"]["elastic_n_per_m3"] = 1;
    EXPECT_EQ(message_of([&] { read(json); }).substr(0, 50),
              "cube.json:/body/material/elastic_n_per_m3: expecte");
}

TEST(BodyDescription, SurfacesAndTubesHaveTwoAxes) {
    Json json = Json::parse(R"({
        "kind": "surface", "grid": [5, 4], "rest": {"sheet_m": [3, 2]},
        "material": {"mass_kg": 4, "elastic_n_per_m3": 0.25, "bending_n_per_m": 0.0001,
                     "bending_parameters": "per-node", "drag_ns_per_m": 0.1},
        "regions": [{"nodes": {"a1": "last"}, "factors": {"bending": 0.5}}],
        "fixed": [{"corners": [[0, 0]], "reach": 1}]})");
    const BodyDescription body = read(json);
    const tissue::GridSurface surface = grid_surface(body);
    EXPECT_EQ(surface.bending, tissue::Parameters::kPerNode);
    EXPECT_EQ(surface.parameters, tissue::Parameters::kResolutionIndependent);
    EXPECT_EQ(surface.material[0].bending_n_per_m, tissue::Mat2::Constant(0.0001));
    EXPECT_EQ(surface.material[19].bending_n_per_m, tissue::Mat2::Constant(0.00005));
    EXPECT_EQ(build_body(body).fixed, (std::vector<int>{0, 1, 4}));

    json["grid"] = {5, 2};
    json["kind"] = "cylinder";
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/grid/1: expected an integer in [3, 1000], found 2");
    json["grid"] = {5, 6};
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/rest/sheet_m: expected one of tube points_m at_m turn, found "
              "unknown key \"sheet_m\"");
    json["rest"] = Json::parse(R"({"tube": {"radius_m": 1, "length_m": 3}})");
    EXPECT_EQ(build_body(read(json)).rest.rows(), 30);
    json["material"]["incompressibility_n_per_m5"] = 1;
    EXPECT_EQ(message_of([&] { read(json); }).substr(0, 62),
              "cube.json:/body/material/incompressibility_n_per_m5: expected ");
}

TEST(BodyDescription, BadNumbersOfSurfacesAreNamedWithTheirPlace) {
    const Json json = Json::parse(R"({
        "kind": "surface", "grid": [3, 3], "rest": {"sheet_m": [1, 1]},
        "material": {"mass_kg": 1, "elastic_n_per_m3": 1, "damping_ns_per_m3": 0.1,
                     "bending_n_per_m": 0.01, "drag_ns_per_m": 0.1}})");
    const auto message = [&](const char* pointer, const char* value) {
        return message_with(pointer, value, json);
    };
    EXPECT_EQ(message("/material/mass_kg", "-1"),
              "cube.json:/body/material/mass_kg: expected a number in (0, inf), found -1");
    EXPECT_EQ(message("/material/elastic_n_per_m3", "{\"11\": 1, \"22\": -1}"),
              "cube.json:/body/material/elastic_n_per_m3/22: expected [0, inf), found -1");
    EXPECT_EQ(message("/material/damping_ns_per_m3", "-0.1"),
              "cube.json:/body/material/damping_ns_per_m3: expected [0, inf), found -0.1");
    EXPECT_EQ(message("/material/bending_n_per_m", "-0.01"),
              "cube.json:/body/material/bending_n_per_m: expected [0, inf), found -0.01");
    EXPECT_EQ(message("/material/drag_ns_per_m", "null"),
              "cube.json:/body/material/drag_ns_per_m: expected a number in [0, inf), found null");
    EXPECT_EQ(message("/grid/0", "1"),
              "cube.json:/body/grid/0: expected an integer in [2, 1000], found 1");
    EXPECT_EQ(message("/grid", "[3, 3, 3]"),
              "cube.json:/body/grid: expected two numbers of nodes, one per axis, found [3,3,3]");
    // Its last row of cells lies on the row before.
    EXPECT_EQ(
        message("/rest", R"({"points_m": [[0, 0, 0], [0, 1, 0], [0, 2, 0], [1, 0, 0], [1, 1, 0],
                                   [1, 2, 0], [0, 0, 1e-3], [0, 1, 1e-3], [0, 2, 1e-3]]})"),
        "cube.json:/body/rest: expected a shape without folds, found cell [0, 0] lying on "
        "the next along m");
    EXPECT_EQ(
        message("/rest", R"({"points_m": [[0, 0, 0], [0, 1, 0], [0, 2, 0], [1, 0, 0], [1, 1, null],
                                   [1, 2, 0], [2, 0, 0], [2, 1, 0], [2, 2, 0]]})"),
        "cube.json:/body/rest/points_m/4/2: expected a number, found null");
}

TEST(BodyDescription, BadNumbersOfCurvesAreNamedWithTheirPlace) {
    const Json json = Json::parse(R"({
        "kind": "curve", "grid": [5], "rest": {"path_m": [[0, 0, 0], [1, 0, 0]]},
        "material": {"mass_kg": 1, "elastic_n_per_m3": 100, "bending_n_per_m": 0.1}})");
    const auto message = [&](const char* pointer, const char* value) {
        return message_with(pointer, value, json);
    };
    EXPECT_EQ(message("/material/mass_kg", "-1"),
              "cube.json:/body/material/mass_kg: expected a number in (0, inf), found -1");
    EXPECT_EQ(message("/material/elastic_n_per_m3", "-100"),
              "cube.json:/body/material/elastic_n_per_m3: expected [0, inf), found -100");
    EXPECT_EQ(message("/material/bending_n_per_m", "-0.1"),
              "cube.json:/body/material/bending_n_per_m: expected [0, inf), found -0.1");
    EXPECT_EQ(message("/grid/0", "1"),
              "cube.json:/body/grid/0: expected an integer in [2, 1000], found 1");
    EXPECT_EQ(message("/rest/path_m/1/1", "null"),
              "cube.json:/body/rest/path_m/1/1: expected a number, found null");
    EXPECT_EQ(
        message("/rest/path_m", "[[0, 0, 0], [1, 0, 0], [0, 0, 0]]"),
        "cube.json:/body/rest/3: expected a shape without folds, found a link turning back on "
        "the one before");
}

TEST(BodyDescription, SpringsPullAndPulsesPushWhereTheySay) {
    Json json = cube();
    json["gravity_m_per_s2"] = {0, 0, 0};
    json["springs"] =
        Json::parse(R"([{"at": [0, 0, 0], "tied_to_m": [-2, 0, 0], "stiffness_n_per_m": 3}])");
    json["pulses"] = Json::parse(
        R"([{"at": [0.5, 0.5, 0], "direction": [0, 5, 0], "shape": "box", "amplitude_n": 7}])");
    const SoftBody body = build_body(read(json));
    Points force;
    body.system.force(0, body.rest, body.start().v, force);
    EXPECT_NEAR(force(0, 0), -6, 1e-12);
    EXPECT_NEAR(force.col(1).sum(), 7, 1e-12);
    json["pulses"][0]["shape"] = "triangle";
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/pulses/0: expected the key \"duration_s\", which a triangle needs, "
              "found none");
    json["springs"][0]["at"] = {0, 0, 2};
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/springs/0/at/2: expected [0, 1], found 2");
}

TEST(BodyDescription, ObstaclesPushBackAndAreChecked) {
    Json json = cube();
    json["gravity_m_per_s2"] = {0, 0, 0};
    json["obstacles"] = Json::parse(R"([{"plane": {"point_m": [0, 0, 0.1], "normal": [0, 0, 1]},
                                         "contact": {"stiffness_pa_per_m": 1000}}])");
    const SoftBody body = build_body(read(json));
    Points force;
    body.system.force(0, body.rest, body.start().v, force);
    EXPECT_GT(force.col(2).sum(), 1);
    json["obstacles"][0]["sphere"] = Json::object();
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/obstacles/0: expected one of \"plane\", \"sphere\" and "
              "\"capsule\", found several");
    json["obstacles"][0].erase("sphere");
    json["obstacles"][0]["contact"]["friction"] = -0.5;
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/obstacles/0/contact/friction: expected [0, inf), found -0.5");
    json["obstacles"][0]["contact"] = {{"thickness_m", 0}};
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/obstacles/0/contact/thickness_m: expected a number in (0, inf), "
              "found 0");
}

TEST(BodyDescription, RestShapesAreTurnedThenMoved) {
    Json json = cube();
    json["rest"] = Json::parse(
        R"({"block_m": [3, 2, 1], "turn": {"axis": [0, 0, 2], "angle_deg": 90}, "at_m": [10, 0, 0]})");
    const Points rest = grid_solid(read(json)).rest;
    EXPECT_NEAR((rest.row(63) - Eigen::RowVector3d(8, 3, 1)).norm(), 0, 1e-12);
    json["rest"]["turn"]["axis"] = {0, 0, 0};
    EXPECT_EQ(message_of([&] { read(json); }),
              "cube.json:/body/rest/turn/axis: expected a direction, found [0,0,0]");
}

TEST(SoftBody, MeasuresVolumeAndStartsAtRest) {
    Json json = cube();
    json["rest"] = Json::parse(R"({"block_m": [3, 2, 1]})");
    const SoftBody body = build_body(read(json));
    EXPECT_NEAR(body.volume(body.rest), 6, 1e-12);
    // Of 4^3 nodes, 3^3 have all forward neighbours. Each dV is per unit of material volume.
    EXPECT_NEAR(body.volume_element_sum(body.rest), 6 * 27, 1e-10);
    EXPECT_EQ(body.length_scale_m, 3);
    EXPECT_EQ(body.fixed.size(), 16u);
    EXPECT_EQ(body.start().v, Points::Zero(64, 3));
    Points force;
    body.system.force(0, body.rest, body.start().v, force);
    EXPECT_NEAR(force.col(2).sum(), -4 * 9.81, 1e-10) << "only weight acts at rest";
}

}  // namespace
}  // namespace risorius::softbody
