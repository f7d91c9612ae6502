#include "experiment/implicit_steps.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "paths.h"

namespace risorius::experiment {
namespace {

Json table_of_the_thesis() {
    return JsonCursor::read_file(std::filesystem::path(RISORIUS_SOURCE_DIR) /
                                 "samples/figures/implicit/experiment.json")
        .json();
}

/// Whether a method comes to rest in the right place with this very step, per grid.
std::vector<bool> usable(Json experiment, const std::string& method, double step_s) {
    experiment["steps"] = Json{{"longest_s", step_s}, {"shortest_s", step_s}, {"per_decade", 1}};
    experiment["ratios"] = Json::array();
    experiment["checks"] = Json::array();
    Json only = Json::array();
    for (const Json& one : experiment["methods"])
        if (one["name"] == method) only.push_back(one);
    experiment["methods"] = only;
    Outcome outcome;
    run_implicit_steps(JsonCursor::from_json(experiment, "table"), {.threads = 1}, outcome);
    std::vector<bool> found;
    for (const Table& table : outcome.figure.tables)
        if (table.name == "longest_step")
            for (const double step : table.rows[0]) found.push_back(step == step_s);
    return found;
}

const std::vector<bool> kAll(3, true), kNone(3, false);

TEST(ImplicitSteps, ImplicitEulerTakesAFifthOfASecondAtEveryResolution) {
    EXPECT_EQ(usable(table_of_the_thesis(), "one-solve", 0.2), kAll);
    EXPECT_EQ(usable(table_of_the_thesis(), "newton", 0.2), kAll);
}

TEST(ImplicitSteps, ItTakesThreeTimesTheStepOfTerzopoulosWithoutDamping) {
    EXPECT_EQ(usable(table_of_the_thesis(), "one-solve", 0.6), kAll);
    for (const double step_s : {0.5, 0.3, 0.2})
        EXPECT_EQ(usable(table_of_the_thesis(), "terzopoulos", step_s), kNone) << step_s;
    EXPECT_EQ(usable(table_of_the_thesis(), "terzopoulos", 0.04), kAll);
}

TEST(ImplicitSteps, ItTakesTenTimesTheStepOfTerzopoulosWithTheRateInTheMatrix) {
    for (const double step_s : {0.2, 0.06, 0.02})
        EXPECT_EQ(usable(table_of_the_thesis(), "terzopoulos-lagged", step_s), kNone) << step_s;
}

std::string message_of(const Json& experiment) {
    Outcome outcome;
    try {
        run_implicit_steps(JsonCursor::from_json(experiment, "table.json"), {.threads = 1},
                           outcome);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(ImplicitSteps, WhatIsWrongIsNamed) {
    Json experiment = table_of_the_thesis();
    experiment["methods"][0]["published_s"] = {1, 2};
    EXPECT_EQ(message_of(experiment),
              "table.json:/methods/0/published_s: expected one number per grid, 3, found 2");
    experiment = table_of_the_thesis();
    experiment["methods"][1]["name"] = "newton";
    EXPECT_EQ(message_of(experiment),
              "table.json:/methods/3/name: expected a name of its own, found \"newton\" again");
    experiment = table_of_the_thesis();
    experiment["ratios"] = {{"newton"}};
    EXPECT_EQ(message_of(experiment).substr(0, 60),
              "table.json:/ratios/0: expected the names of two methods, fou");
}

TEST(ImplicitSteps, ManyThreadsFindTheSame) {
    Json experiment = table_of_the_thesis();
    experiment["grids"] = {{5, 5}, {6, 6}};
    experiment["methods"].erase(0);
    experiment["methods"][1].erase("published_s");
    experiment["ratios"] = Json::array();
    experiment["steps"]["per_decade"] = 3;
    experiment["steps"]["shortest_s"] = 0.01;
    experiment["rest"]["duration_s"] = 10;
    Outcome one, two;
    run_implicit_steps(JsonCursor::from_json(experiment, "table"), {.threads = 1}, one);
    run_implicit_steps(JsonCursor::from_json(experiment, "table"), {.threads = 2}, two);
    ASSERT_EQ(one.figure.tables.size(), two.figure.tables.size());
    for (std::size_t i = 0; i < one.figure.tables.size(); ++i)
        EXPECT_EQ(one.figure.tables[i].rows, two.figure.tables[i].rows);
    EXPECT_EQ(one.figure.shapes[1].positions, two.figure.shapes[1].positions);
}

}  // namespace
}  // namespace risorius::experiment
