// SPDX-License-Identifier: MIT
// Experiment files: what the registry knows, that all samples read, and what a person reads when one is wrong.
#include "risorius/figures/registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "figures/samples.h"
#include "risorius/figures/detail/experiment_kind.h"

namespace risorius::figures {
namespace {

/// Reads everything and runs nothing: asked to stop at the first chance.
void read_only(const JsonCursor& experiment) {
    RunOptions options;
    options.monitor.stopped = [] { return true; };
    run_figure(experiment, options);
}

TEST(Registry, EverySampleReadsWithoutError) {
    int files = 0;
    for (const auto& folder : std::filesystem::directory_iterator(samples_folder())) {
        const auto file = folder.path() / "experiment.json";
        if (!std::filesystem::exists(file)) continue;
        ++files;
        EXPECT_THROW(read_only(JsonCursor::read_file(file)), Interrupted) << file;
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "README.md")) << folder.path();
    }
    EXPECT_GE(files, 7);
}

TEST(Registry, EveryFigureHasItsSampleOfItsKind) {
    const auto names = kinds();
    for (const Figure& figure : figures()) {
        const Json experiment = sample(std::string(figure.id));
        EXPECT_EQ(experiment.at("figure"), figure.id);
        EXPECT_EQ(experiment.at("kind"), figure.kind);
        EXPECT_TRUE(std::find(names.begin(), names.end(), figure.kind) != names.end());
        EXPECT_GT(figure.run_time_s, 0);
    }
}

TEST(Registry, WrongFilesAreNamedWithTheirPlace) {
    const auto message = [](const char* pointer, Json value) {
        Json json = sample("5");
        json[Json::json_pointer(pointer)] = std::move(value);
        return message_of([&] { read_only(JsonCursor::from_json(json, "mine.json")); });
    };
    EXPECT_EQ(message("/format", "risorius-script"),
              "mine.json:/format: expected \"risorius-experiment\", found \"risorius-script\"");
    EXPECT_EQ(message("/version", 2), "mine.json:/version: expected an integer in [1, 1], found 2");
    EXPECT_EQ(message("/kind", "equilibria").substr(0, 46),
              "mine.json:/kind: expected one of \"equilibrium\"");
    EXPECT_EQ(message("/body/material/mass_kg", -1),
              "mine.json (rest):/body/material/mass_kg: expected a number in (0, inf), found -1");
    EXPECT_EQ(message("/cases/2/change/grid", {4, 4, 1}),
              "mine.json (raw-4x4x4):/body/grid/2: expected an integer in [2, 1000], found 1");
    EXPECT_EQ(message("/cases/2/name", "rest"),
              "mine.json:/cases/2/name: expected a name of its own, found \"rest\" again");
    EXPECT_EQ(message("/steps", 3).substr(0, 26), "mine.json:/steps: expected");
}

TEST(Registry, EveryGridHasItsStepOrNone) {
    Json json = sample("9b");
    json["runs"][0]["steps_s"] = {1e-3, 1e-3};
    EXPECT_EQ(message_of([&] { read_only(JsonCursor::from_json(json, "mine.json")); }),
              "mine.json:/runs/0/steps_s: expected as many steps as \"grids\", 11, found 2");
}

/// An experiment of minutes does not end in a message about its last lines.
TEST(Registry, ListsOfChecksAreReadBeforeAnythingIsSimulated) {
    Json json = sample("5");
    json["checks"] = Json::parse(R"([{"measured": "anything", "low": 2, "high": 1}])");
    EXPECT_EQ(message_of([&] { read_only(JsonCursor::from_json(json, "mine.json")); }),
              "mine.json:/checks/0/low: expected at most \"high\", which is 1, found 2");
    json["checks"] = Json::array();
    json["claims"] =
        Json::parse(R"([{"says": "It falls.", "finds": "It falls.", "verdict": "so"}])");
    EXPECT_EQ(
        message_of([&] { read_only(JsonCursor::from_json(json, "mine.json")); }).substr(0, 47),
        "mine.json:/claims/0/verdict: expected one of \"a");
}

TEST(Registry, ChecksNameWhatWasMeasured) {
    Json json = sample("5");
    json["cases"] = Json::array({json["cases"][1]});
    forget_numbers(json);
    json["checks"] = Json::parse(R"([{"measured": "length/raw-3x3x3"}])");
    EXPECT_EQ(message_of([&] { run(json); }),
              "experiment.json:/checks/0/measured: expected one of \"length_ratio/raw-3x3x3\" "
              "\"drift_ratio/raw-3x3x3\" \"volume_change_percent/raw-3x3x3\" "
              "\"greatest_move_m/raw-3x3x3\" \"force_ratio/raw-3x3x3\" \"diverged/raw-3x3x3\", "
              "found \"length/raw-3x3x3\"");

    json["checks"] =
        Json::parse(R"([{"measured": "length_ratio/raw-3x3x3", "low": 2, "high": 1}])");
    EXPECT_EQ(message_of([&] { run(json); }),
              "experiment.json:/checks/0/low: expected at most \"high\", which is 1, found 2");

    json["checks"] = Json::parse(
        R"([{"measured": "length_ratio/raw-3x3x3", "range": "law", "published": "long"}])");
    EXPECT_EQ(message_of([&] { run(json); }),
              "experiment.json:/checks/0/published: expected nothing unless \"range\" is "
              "\"published\", found \"long\"");

    json["checks"] = Json::parse(R"([{"measured": "length_ratio/raw-3x3x3", "range": "own"}])");
    EXPECT_EQ(message_of([&] { run(json); }),
              "experiment.json:/checks/0/range: expected one of \"published\" \"law\" \"demand\", "
              "found \"own\"")
        << "a range around one's own value proves nothing";

    json["checks"] = Json::parse(R"([{"measured": "length_ratio/raw-3x3x3", "low": 2}])");
    EXPECT_FALSE(run(json).passes()) << "a band it does not meet is a result, not an error";
}

/// Figure 5 with one cube, which hangs to 1.785 of its length, and one claim.
FigureResult with_claim(const char* claim) {
    Json json = sample("5");
    json["cases"] = Json::array({json["cases"][1]});
    forget_numbers(json);
    Json read = Json::parse(claim);
    read["says"] = "It hangs.";
    read["finds"] = "It does.";
    json["claims"] = Json::array({read});
    return run(json);
}

TEST(Registry, AVerdictIsWhatTheMeasurementSays) {
    const auto holds = [](const char* claim) { return with_claim(claim).passes(); };
    EXPECT_TRUE(
        holds(R"({"verdict": "agrees", "measured": "length_ratio/raw-3x3x3", "low": 1.7})"));
    EXPECT_FALSE(
        holds(R"({"verdict": "agrees", "measured": "length_ratio/raw-3x3x3", "low": 1.9})"));
    EXPECT_TRUE(
        holds(R"({"verdict": "missed", "measured": "length_ratio/raw-3x3x3", "low": 1.9})"));
    EXPECT_FALSE(
        holds(R"({"verdict": "missed", "measured": "length_ratio/raw-3x3x3", "low": 1.7})"))
        << "what was missed and is met now must not stay missed on the page";
    EXPECT_TRUE(holds(R"({"verdict": "cannot be known"})"));
    EXPECT_TRUE(holds(R"({"verdict": "missed"})"));
}

TEST(Registry, AClaimMayBeAboutARatio) {
    const FigureResult figure = with_claim(
        R"({"verdict": "agrees", "measured": "greatest_move_m/raw-3x3x3",
            "over": "length_ratio/raw-3x3x3", "low": 1, "high": 2})");
    ASSERT_EQ(figure.claims.size(), 1u);
    EXPECT_DOUBLE_EQ(figure.claims[0].value, measured(figure, "greatest_move_m/raw-3x3x3") /
                                                 measured(figure, "length_ratio/raw-3x3x3"));
    EXPECT_EQ(figure.claims[0].name, "greatest_move_m/raw-3x3x3 over length_ratio/raw-3x3x3");
}

TEST(Registry, AClaimThatCannotBeKnownHasNoBandAndABandHasAMeasurement) {
    EXPECT_EQ(
        message_of([] {
            with_claim(R"({"verdict": "cannot be known",
                                 "measured": "length_ratio/raw-3x3x3", "low": 1})");
        }),
        "experiment.json:/claims/0/measured: expected nothing where the verdict is \"cannot be "
        "known\", found \"length_ratio/raw-3x3x3\"");
    EXPECT_EQ(message_of([] { with_claim(R"({"verdict": "missed", "low": 1})"); }),
              "experiment.json:/claims/0/low: expected \"measured\" beside it, found 1");
    EXPECT_EQ(
        message_of(
            [] { with_claim(R"({"verdict": "missed", "measured": "length_ratio/raw-3x3x3"})"); }),
        "experiment.json:/claims/0/measured: expected a measurement with \"low\" or \"high\", "
        "found \"length_ratio/raw-3x3x3\"");
}

// A band that passes anything says nothing, and neither does a verdict without a reason.
TEST(Registry, ClaimsOfTheThesisAreNarrowWhereItPrintsNumbers) {
    int claims = 0, missed = 0, unknown = 0;
    for (const Figure& figure : figures()) {
        const Json json = sample(std::string(figure.id));
        EXPECT_EQ(json.contains("claims"), figure.origin == Origin::kThesis) << figure.id;
        if (!json.contains("claims")) continue;
        for (const Json& claim : json["claims"]) {
            ++claims;
            missed += claim["verdict"] == "missed";
            unknown += claim["verdict"] == "cannot be known";
            if (claim["verdict"] == "missed") {
                EXPECT_TRUE(claim.contains("measured")) << claim;
            }
            if (!claim.contains("low") || !claim.contains("high")) continue;
            const double low = claim["low"], high = claim["high"];
            EXPECT_TRUE(low <= 0 || high / low <= 4.01 || figure.id == "12a") << claim;
        }
    }
    EXPECT_GT(claims, 40);
    EXPECT_GT(missed, 10);
    EXPECT_GT(unknown, 7);
}

TEST(Registry, BandsOfWatchedNumbersAreNarrow) {
    int watched = 0;
    for (const Figure& figure : figures()) {
        const Json json = sample(std::string(figure.id));
        for (const Json& number : json.value("watched", Json::array())) {
            ++watched;
            ASSERT_TRUE(number.contains("low") && number.contains("high")) << number;
            const double low = number["low"], high = number["high"];
            EXPECT_TRUE(low <= 0 || high / low < 2.01) << figure.id << " " << number;
        }
    }
    EXPECT_GT(watched, 30);
}

TEST(Registry, ParallelWorkEndsWithItsFirstFailure) {
    std::vector<int> done(100, 0);
    parallel_for(100, 3, [&](int i) { done[static_cast<std::size_t>(i)] = i; });
    for (int i = 0; i < 100; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
    EXPECT_THROW(parallel_for(10, 2,
                              [](int i) {
                                  if (i == 3) throw std::out_of_range("3");
                              }),
                 std::out_of_range);
    parallel_for(0, 2, [](int) { FAIL() << "nothing to do"; });
}

TEST(Registry, NestedWorkSharesItsThreads) {
    // Three threads between four outer pieces of five inner ones each: never more at work at once, all done.
    SpareThreads spare(2);
    const ThreadLimit limit(3, &spare);
    std::atomic<int> at_work{0}, max{0};
    std::vector<int> done(20, 0);
    parallel_for(4, limit, [&](int outer) {
        parallel_for(5, limit, [&](int inner) {
            const int now = ++at_work;
            for (int seen = max; now > seen && !max.compare_exchange_weak(seen, now);) {
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            ++done[static_cast<std::size_t>(5 * outer + inner)];
            --at_work;
        });
    });
    EXPECT_EQ(done, std::vector<int>(20, 1));
    EXPECT_GT(max, 1);
    EXPECT_LE(max, 5) << "three, and two more while lent threads come back";
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(spare.take());
    EXPECT_FALSE(spare.take()) << "all are given back, and no more than there were";
}

TEST(Registry, EqualRunsRunOnce) {
    SpareThreads spare(3);
    SharedRuns shared(&spare);
    std::atomic<int> runs{0};
    const std::function<int()> run = [&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        return ++runs;
    };
    parallel_for(8, {4, &spare},
                 [&](int i) { EXPECT_GT(*shared.get<int>(i % 2 ? "odd" : "even", run), 0); });
    EXPECT_EQ(runs, 2);
    EXPECT_EQ(shared.get<int>("odd", run), shared.get<int>("odd", run));
}

}  // namespace
}  // namespace risorius::figures
