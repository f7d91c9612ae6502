// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/implicit_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "paths.h"
#include "risorius/core/error.h"

namespace risorius::figures {
namespace {

Json table_of_the_thesis() {
    return JsonCursor::read_file(std::filesystem::path(RISORIUS_SOURCE_DIR) /
                                 "samples/figures/implicit/experiment.json")
        .json();
}

/// Which of the methods come to rest in the right place with this very step, one flag per grid.
std::map<std::string, std::vector<bool>> usable(double step_s,
                                                const std::vector<std::string>& methods) {
    Json experiment = table_of_the_thesis();
    experiment["steps"] = Json{{"longest_s", step_s}, {"shortest_s", step_s}, {"per_decade", 1}};
    experiment["ratios"] = Json::array();
    forget_numbers(experiment);
    experiment["rest"]["integrator"]["step_s"] = 1;  // damps as well and takes a tenth of the steps
    Json chosen = Json::array();
    for (const Json& one : experiment["methods"])
        if (std::find(methods.begin(), methods.end(), one["name"]) != methods.end())
            chosen.push_back(one);
    experiment["methods"] = chosen;
    Outcome outcome;
    run_implicit_steps(JsonCursor::from_json(experiment, "table"), {.threads = 1}, outcome);
    std::map<std::string, std::vector<bool>> found;
    for (const Table& table : outcome.figure.tables) {
        if (table.name == "longest_step")
            for (std::size_t m = 0; m < table.rows.size(); ++m)
                for (const double step : table.rows[m])
                    found[table.row_names[m]].push_back(step == step_s);
        if (table.name == "rest") {
            for (const auto& row : table.rows) EXPECT_LT(row[0], 1e-9) << "hangs still";
        }
    }
    return found;
}

const std::vector<bool> kAll(3, true), kNone(3, false);

TEST(ImplicitSteps, ImplicitEulerTakesAFifthOfASecondAtEveryResolutionAndTerzopoulosDoesNot) {
    auto found = usable(0.2, {"one-solve", "newton", "terzopoulos", "terzopoulos-lagged"});
    EXPECT_EQ(found["one-solve"], kAll);
    EXPECT_EQ(found["newton"], kAll);
    EXPECT_EQ(found["terzopoulos"], kNone);
    EXPECT_EQ(found["terzopoulos-lagged"], kNone);
}

TEST(ImplicitSteps, ItTakesThreeTimesTheStepOfTerzopoulosWithoutDamping) {
    auto found = usable(0.6, {"one-solve", "terzopoulos"});
    EXPECT_EQ(found["one-solve"], kAll);
    EXPECT_EQ(found["terzopoulos"], kNone);
    EXPECT_EQ(usable(0.35, {"terzopoulos"})["terzopoulos"], kNone);
    EXPECT_EQ(usable(0.04, {"terzopoulos"})["terzopoulos"], kAll) << "which is no broken method";
}

TEST(ImplicitSteps, ItTakesTenTimesTheStepOfTerzopoulosWithTheRateInTheMatrix) {
    for (const double step_s : {0.06, 0.02})
        EXPECT_EQ(usable(step_s, {"terzopoulos-lagged"})["terzopoulos-lagged"], kNone) << step_s;
}

std::string message_about(const Json& experiment) {
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
    EXPECT_EQ(message_about(experiment),
              "table.json:/methods/0/published_s: expected one number per grid, 3, found 2");
    experiment = table_of_the_thesis();
    experiment["methods"][1]["name"] = "newton";
    EXPECT_EQ(message_about(experiment),
              "table.json:/methods/3/name: expected a name of its own, found \"newton\" again");
    experiment = table_of_the_thesis();
    experiment["ratios"] = {{"newton"}};
    EXPECT_EQ(message_about(experiment).substr(0, 60),
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

TEST(ImplicitSteps, ABodyThatIsNoObjectIsNamed) {
    Json experiment = table_of_the_thesis();
    experiment["body"] = {1, 2};
    EXPECT_EQ(message_of([&] {
                  Outcome outcome;
                  run_implicit_steps(JsonCursor::from_json(experiment, "table"), {.threads = 1},
                                     outcome);
              }),
              "table:/body: expected an object, found [1,2]");
}

}  // namespace
}  // namespace risorius::figures
