// SPDX-License-Identifier: MIT
// Solids of cells against problems whose solution is known, on few cells.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "figures/samples.h"

namespace risorius::figures {
namespace {

FigureResult solved(const std::string& problem, const std::vector<int>& cells,
                    const std::vector<double>& ratios) {
    Json json = sample(problem);
    forget_numbers(json);
    json["cells"] = cells;
    json["poisson_ratios"] = ratios;
    return run(json);
}

TEST(Verification, ThePatchTestIsExact) {
    const FigureResult figure = solved("patch", {2, 3}, {0.3, 0.499});
    for (const char* name : {"error/0.3/2", "error/0.3/3", "error/0.499/2", "error/0.499/3"})
        EXPECT_LT(measured(figure, name), 1e-12) << name;
    EXPECT_EQ(figure.charts.size(), 1u);
}

TEST(Verification, AManufacturedSolutionIsFoundWithTheSquareOfTheSpacing) {
    const FigureResult figure = solved("manufactured", {3, 6}, {0, 0.49});
    EXPECT_NEAR(measured(figure, "order/0/6"), 2, 0.2);
    EXPECT_NEAR(measured(figure, "order/0.49/6"), 2, 0.2);
}

TEST(Verification, TorsionConvergesToThatOfTheCircle) {
    const FigureResult figure = solved("torsion", {2, 4}, {0.3});
    EXPECT_NEAR(measured(figure, "order/0.3/4"), 2, 0.2);
    EXPECT_NEAR(measured(figure, "torque_ratio/0.3/4"), 0.95, 0.01);
}

TEST(Verification, CooksPanelComesNearFromBelow) {
    const FigureResult figure = solved("cook", {4, 8}, {0.333333});
    const double coarse = measured(figure, "tip/0.333333/4"),
                 fine = measured(figure, "tip/0.333333/8");
    EXPECT_LT(coarse, fine);
    EXPECT_LT(fine, 23.96);
    EXPECT_NEAR((4 * fine - coarse) / 3, 23.96, 0.6);  // without the error of second order
}

// The same numbers as a program of linear cells in Python, which shares no code and assembles from strain matrices.
TEST(Verification, TheCantileverHasTheDeflectionOfASecondImplementation) {
    const FigureResult figure = solved("cantilever", {1, 2}, {0, 0.3, 0.49, 0.499});
    const std::pair<const char*, double> python[] = {
        {"0/1", 0.6660},    {"0/2", 0.8880},    {"0.3/1", 0.8644},   {"0.3/2", 0.9364},
        {"0.49/1", 0.9897}, {"0.49/2", 0.9225}, {"0.499/1", 0.9956}, {"0.499/2", 0.9207}};
    for (const auto& [name, ratio] : python)
        EXPECT_NEAR(measured(figure, std::string("deflection_ratio/") + name), ratio, 2e-4) << name;
}

// The goal of the issue: within 2 % with two cells across, for Poisson's ratios from 0 to 0.499.
TEST(Verification, ABarOfBendingCellsDeflectsAsTimoshenkoSays) {
    const FigureResult figure = solved("bar", {1, 2}, {0, 0.3, 0.49, 0.499});
    for (const char* name :
         {"0/1", "0/2", "0.3/1", "0.3/2", "0.49/1", "0.49/2", "0.499/1", "0.499/2"})
        EXPECT_NEAR(measured(figure, std::string("deflection_ratio/") + name), 1, 0.005) << name;
}

// The clamped solid of cells with 27 nodes (tests/second/clamped_bar.py), and that program's own bending cells.
TEST(Verification, AClampedBarOfBendingCellsDeflectsAsTheSolid) {
    const FigureResult figure = solved("clamped", {2}, {0, 0.3, 0.49, 0.499});
    for (const char* name : {"0/2", "0.3/2", "0.49/2", "0.499/2"})
        EXPECT_NEAR(measured(figure, std::string("deflection_ratio/") + name), 1, 0.01) << name;
    Json cubes = sample("clamped");
    forget_numbers(cubes);
    cubes.erase("lengthwise");
    cubes.erase("solutions");
    cubes["cells"] = {2};
    const FigureResult over_timoshenko = run(cubes);
    const std::pair<const char*, double> python[] = {
        {"0/2", 0.9984}, {"0.3/2", 0.9871}, {"0.49/2", 0.9580}, {"0.499/2", 0.9556}};
    for (const auto& [name, ratio] : python)
        EXPECT_NEAR(measured(over_timoshenko, std::string("deflection_ratio/") + name), ratio, 2e-4)
            << name;
}

// NAFEMS 1990, LE10: 5.38; with four cells through the thickness within 3 %.
TEST(Verification, TheThickPlateHasThePublishedStress) {
    const FigureResult figure = solved("thick-plate", {2, 4}, {0.3});
    EXPECT_NEAR(measured(figure, "stress/0.3/4"), 5.38, 0.16);
    EXPECT_GT(measured(figure, "order/0.3/4"), 1);
}

// rho g L / (2 E) = 0.24525 % of the volume, as the README of the sample derives.
TEST(MeshInEquilibrium, AColumnHangsAsTheClosedForm) {
    Json json = sample("mesh");
    forget_numbers(json);
    json["cases"] = Json::array({json["cases"].back()});
    json["body"]["mesh"]["file"] = (samples_folder() / "mesh" / "column.mesh").string();
    EXPECT_NEAR(measured(run(json), "volume_change_percent/light"), 0.24525, 0.002);
    json["length_along"] = "a3";
    EXPECT_EQ(message_of([&] { check_experiment(JsonCursor::from_json(json, "mine.json")); }),
              "mine.json:/length_along: expected no axis, since a mesh has none, found \"a3\"");
}

TEST(Verification, WrongPlansAreRefused) {
    const auto message = [](const char* pointer, const Json& value) {
        Json json = sample("cook");
        json[Json::json_pointer(pointer)] = value;
        return message_of([&] { check_experiment(JsonCursor::from_json(json, "mine.json")); });
    };
    EXPECT_EQ(message("/problem", "beam").substr(0, 47),
              "mine.json:/problem: expected one of \"cantilever");
    EXPECT_EQ(message("/element", "bending-cells"),
              "mine.json:/element: expected cells: those of this problem are no boxes, found "
              "\"bending-cells\"");
    EXPECT_EQ(
        message("/lengthwise", 2),
        "mine.json:/lengthwise: expected no such key but for the problem \"cantilever\", found "
        "2");
    EXPECT_EQ(message("/cells", {4, 4}),
              "mine.json:/cells/1: expected more cells than before, found 4");
    EXPECT_EQ(message("/cells", {5}),
              "mine.json:/cells/0: expected an even number of cells, found 5");
    EXPECT_EQ(message("/poisson_ratios/0", 0.5),
              "mine.json:/poisson_ratios/0: expected [0, 0.4999], found 0.5");
}

}  // namespace
}  // namespace risorius::figures
