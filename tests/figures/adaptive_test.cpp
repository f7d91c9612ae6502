// SPDX-License-Identifier: MIT
// Adaptive against uniform resolution: the shortened figure, the same bytes for any number of threads, and wrong files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "figures/samples.h"

namespace risorius::figures {
namespace {

/// One halving in place of two, and a reference to match.
Json shortened() {
    Json json = sample("adaptive");
    for (Json& one : json["cases"]) {
        one["uniform_levels"] = 1;
        one["refine"] = {{"tolerance", 0.35}, {"deepest_level", 1}, {"rounds", 2}};
        one["reference"] = {{"tolerance", 0.3}, {"deepest_level", 2}, {"rounds", 3}};
    }
    forget_numbers(json);
    return json;
}

TEST(Adaptive, AnswersAreNearTheUniformOnesForLessWork) {
    const FigureResult figure = run(shortened());
    for (const std::string of : {"/cube", "/block"}) {
        EXPECT_EQ(measured(figure, "converged" + of), 1);
        EXPECT_LT(measured(figure, "difference_percent" + of), 3) << of;
        EXPECT_LT(measured(figure, "work_share" + of), 0.85) << of;
        EXPECT_LT(measured(figure, "adaptive_nodes" + of),
                  0.6 * measured(figure, "uniform_nodes" + of));
        EXPECT_LT(measured(figure, "mass_change_ratio" + of), 1e-12);
    }
    // The cube hangs by its weight; the block is pushed in, so its side bulges and it becomes smaller
    EXPECT_NEAR(measured(figure, "uniform_move_m/cube"), 0.375, 0.005);
    EXPECT_GT(measured(figure, "uniform_push_n/block"), 1);
    EXPECT_GT(measured(figure, "uniform_move_m/block"), 0);
    EXPECT_LT(measured(figure, "uniform_volume_change_percent/block"), 0);

    const Table& meshes = table_of(figure, "meshes");
    EXPECT_EQ(meshes.row_names.front(), "cube/uniform/0");
    EXPECT_EQ(figure.charts.size(), 2u);
    ASSERT_EQ(figure.shapes.size(), 2u);
    for (const Shape& shape : figure.shapes) {
        EXPECT_EQ(static_cast<Eigen::Index>(shape.shade.size()), shape.positions.rows());
        EXPECT_FALSE(shape.fixed.empty());
    }
}

TEST(Adaptive, ResultsDoNotDependOnTheNumberOfThreads) {
    Json json = shortened();
    json["cases"].erase(0);
    const Table one = table_of(run(json, {.threads = 1}), "meshes");
    EXPECT_EQ(table_of(run(json, {.threads = 3}), "meshes").rows, one.rows);
}

TEST(Adaptive, WrongFilesAreNamedWithTheirPlace) {
    const auto message = [](const char* pointer, Json value) {
        Json json = sample("adaptive");
        json[Json::json_pointer(pointer)] = std::move(value);
        return message_of([&] {
            RunOptions options;
            options.monitor.stopped = [] { return true; };
            run(json, options);
        });
    };
    EXPECT_EQ(
        message("/cases/0/body/discretisation", "differences"),
        "experiment.json:/cases/0/body/discretisation: expected \"cells\", which can be refined, "
        "found \"differences\"");
    EXPECT_EQ(message("/cases/0/refine/tolerance", 0),
              "experiment.json:/cases/0/refine/tolerance: expected a number in (0, 1), found 0");
    EXPECT_EQ(message("/cases/1/refine/merge_below", 1),
              "experiment.json:/cases/1/refine/merge_below: expected a number in [0, 1), found 1");
    EXPECT_EQ(
        message("/cases/1/reference/deepest_level", 9),
        "experiment.json:/cases/1/reference/deepest_level: expected an integer in [0, 8], found 9");
    EXPECT_EQ(message("/cases/1/name", "cube"),
              "experiment.json:/cases/1/name: expected a name of its own, found \"cube\" again");
    EXPECT_EQ(message("/cases/1/watch", Json::object()),
              "experiment.json:/cases/1/watch: expected one of \"a1\" \"a2\" \"a3\", found an "
              "object with 0 keys");
    EXPECT_EQ(message("/cases/1/push/nodes/a3", 4),
              "experiment.json:/cases/1/push/nodes/a3: expected an index in [-4, 3] of this grid, "
              "found 4");
    EXPECT_EQ(message("/cases/1/push/nodes/a3", {{"from", 0.5}, {"to", 0.6}}).substr(0, 75),
              "experiment.json:/cases/1/push/nodes: expected at least one node, found an o");
    EXPECT_EQ(message("/cases/1/push/move_m", {0, 0, 0}).substr(0, 55),
              "experiment.json:/cases/1/push/move_m: expected a move, ");
    EXPECT_EQ(message("/integrator/linear", "direct"),
              "experiment.json:/integrator/linear: expected \"conjugate\", whose work is counted, "
              "found \"direct\"");
}

}  // namespace
}  // namespace risorius::figures
