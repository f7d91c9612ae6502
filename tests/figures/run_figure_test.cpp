// SPDX-License-Identifier: MIT
// The presentation of figures, with experiments made up here: what they measure is tested beside them.
#include "risorius/figures/run_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/figures/figure_page.h"
#include "risorius/media/image_file.h"
#include "temporary_folder.h"

namespace risorius::figures {
namespace {

namespace fs = std::filesystem;
using figures::FigureResult;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One pyramid over a square.
figures::Shape pyramid(const std::string& name, const std::string& caption, double height) {
    figures::Shape shape;
    shape.name = name;
    shape.caption = caption;
    shape.positions.resize(5, 3);
    shape.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, height;
    shape.surface.resize(6, 3);
    shape.surface << 0, 2, 1, 0, 3, 2, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4;
    shape.wires = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
    shape.fixed = {0, 1};
    return shape;
}

/// What an experiment with the file's "figure" leaves, without what takes time to draw.
FigureResult numbers(const JsonCursor& experiment, const figures::RunOptions& options) {
    options.monitor.report(0.5, "half");
    FigureResult result;
    result.id = experiment.at("figure").string();
    result.title = "A <made-up> figure & more";
    result.tables.push_back(
        {"numbers", {"time_s", "b, c"}, {{0.1, NAN}, {1e-9, kInfinity}}, {"a \"x\"", "y"}});
    result.checks.push_back({"peak", "%", 10.82, 8, 13, "up to ~10 %", "other <camera>"});
    result.checks.back().range_from = "published";
    result.watched.push_back({"steps", "", 7, 6, 8, "", ""});
    result.claims.push_back({.says = "The peak is about 5 %.",
                             .finds = "It is twice as high.",
                             .verdict = Verdict::kMissed,
                             .measured = true,
                             .name = "peak",
                             .unit = "%",
                             .value = 10.82,
                             .low = 4,
                             .high = 6});
    result.claims.push_back({.says = "It looks <round>.",
                             .finds = "There is no number.",
                             .verdict = Verdict::kUnknown});
    if (experiment.has("agrees")) result.claims[0].verdict = Verdict::kAgrees;
    result.checks.push_back({"drift", "", 1e-5, -kInfinity, 1e-4, "", ""});
    if (experiment.has("measured"))
        result.checks.push_back(
            {"length", "m", experiment.at("measured").number(), 1, 2, "about 1.5 m", ""});
    result.record["threads_do_not_matter"] = 1;
    return result;
}

/// The same with a chart and pictures.
FigureResult drawn(const JsonCursor& experiment, const figures::RunOptions& options) {
    FigureResult result = numbers(experiment, options);
    plot::Chart chart;
    chart.name = "curve";
    chart.title = "Curve";
    chart.x.label = "time (s)";
    chart.y.label = "length (m)";
    chart.series.push_back({"cube, 3^3", {0, 1, 2}, {0, 1, 4}});
    result.charts.push_back(chart);
    result.shapes.push_back(pyramid("alone", "A pyramid", 1));
    result.shapes.push_back(pyramid("row", "low", 0.5));
    result.shapes.push_back(pyramid("row", "high", 1.5));
    return result;
}

/// A folder of experiments, and results in another one.
class Figures : public testing::Test {
  protected:
    void add(const std::string& id, const std::string& more = "", const std::string& readme = "") {
        fs::create_directories(folder_ / "from" / id);
        std::ofstream(folder_ / "from" / id / "experiment.json")
            << "{\"format\": \"risorius-experiment\", \"version\": 1, \"figure\": \"" << id
            << "\", \"title\": \"Figure " << id << "\"" << more << "}\n";
        if (!readme.empty()) std::ofstream(folder_ / "from" / id / "README.md") << readme;
    }
    FigureOptions options(const std::string& figure, const FigureRunner& run = numbers) {
        return {.figure = figure, .out = out(), .from = folder_ / "from", .run = run};
    }
    fs::path out() const { return folder_ / "results/out"; }
    std::string message(const FigureOptions& given) {
        try {
            run_figures(given);
        } catch (const Error& error) {
            return error.what();
        } catch (const RunError& error) {
            return std::string("run: ") + error.what();
        }
        return "no error";
    }
    bool nothing_written() const { return !fs::exists(folder_ / "results"); }

    TemporaryFolder folder_;
};

std::set<std::string> files_of(const fs::path& folder) {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory()) files.insert(entry.path().lexically_relative(folder));
    return files;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_F(Figures, OneLeavesItsNumbersChartsPicturesAndPage) {
    add("x1");
    const FigureReport report = run_figures(options("x1", drawn));
    EXPECT_TRUE(report.failed.empty());
    const std::set<std::string> expected{"alone.png",  "curve.data.csv", "curve.gp",
                                         "curve.png",  "curve.svg",      "experiment.json",
                                         "index.html", "numbers.csv",    "results.json",
                                         "row.png",    "timing.json"};
    EXPECT_EQ(files_of(out()), expected);
    const Json results = JsonCursor::read_file(out() / "results.json").json();
    EXPECT_EQ(results, report.results);
    EXPECT_EQ(results["format"], "risorius-figure");
    EXPECT_EQ(results["id"], "x1");
    EXPECT_EQ(results["passes"], true);
    EXPECT_EQ(results["files"].get<std::set<std::string>>(), expected);
    EXPECT_EQ(results["checks"][0]["measured"], 10.82);
    EXPECT_EQ(results["checks"][0]["range"], "published");
    EXPECT_EQ(results["watched"][0]["name"], "steps");
    EXPECT_EQ(results["claims"][0]["verdict"], "missed");
    EXPECT_EQ(results["claims"][0]["holds"], true);
    EXPECT_EQ(results["claims"][0]["high"], 6);
    EXPECT_EQ(results["claims"][1]["verdict"], "cannot be known");
    EXPECT_FALSE(results["claims"][1].contains("measured"));
    EXPECT_EQ(results["checks"][1]["low"], nullptr) << "JSON has no infinity";
    EXPECT_EQ(results["record"]["threads_do_not_matter"], 1);
    EXPECT_EQ(bytes_of(out() / "experiment.json"), bytes_of(folder_ / "from/x1/experiment.json"));
    EXPECT_EQ(bytes_of(out() / "numbers.csv"),
              "name,time_s,\"b, c\"\n\"a \"\"x\"\"\",0.1,nan\ny,1e-09,inf\n");
    EXPECT_EQ(media::read_png(out() / "alone.png").width_px, 1200);
    EXPECT_EQ(media::read_png(out() / "row.png").width_px, 1280);
}

TEST_F(Figures, AllLeaveOnePageAndAFolderEach) {
    add("x1");
    add("x2", ", \"measured\": 2.5", "# Why\n\nIt is *longer*.\n");
    const FigureReport report = run_figures(options("all", drawn));
    ASSERT_EQ(report.failed.size(), 1u);
    EXPECT_EQ(report.failed[0].figure, "x2");
    EXPECT_EQ(report.failed[0].what, "length: expected 1 to 2 m, found 2.5 m");
    EXPECT_EQ(report.results["format"], "risorius-figures");
    EXPECT_EQ(report.results["passes"], false);
    EXPECT_EQ(report.results["figures"][0]["passes"], true);
    EXPECT_EQ(report.results["files"].get<std::set<std::string>>(), files_of(out()));
    EXPECT_TRUE(fs::exists(out() / "x1/results.json"));
    EXPECT_FALSE(fs::exists(out() / "x1/index.html"));
    const std::string page = bytes_of(out() / "index.html");
    for (const char* part : {"src=\"x1/curve.svg\"",
                             "src=\"x2/row.png\"",
                             "href=\"x2/results.json\"",
                             "up to ~10 %",
                             "10.82 %",
                             "8 to 13 %",
                             "at most 0.0001",
                             "2.5 m",
                             "1 to 2 m",
                             "✗ outside",
                             "✓ inside",
                             "2 of 3",
                             "≠ missed",
                             "? cannot be known",
                             "It looks &lt;round&gt;.",
                             "4 to 6 %",
                             "They prove nothing",
                             "what was published: up to ~10 %",
                             "href=\"x2/experiment.json\"",
                             "href=\"#figure-x2\"",
                             "id=\"figure-x2\"",
                             "<p>It is <em>longer</em>.</p>",

                             "low | high"})
        EXPECT_TRUE(contains(page, part)) << part;
}

TEST_F(Figures, AVerdictThatIsNotMeasuredFails) {
    add("x1", ", \"agrees\": true");
    const FigureReport report = run_figures(options("x1"));
    ASSERT_EQ(report.failed.size(), 1u);
    EXPECT_EQ(report.failed[0].what,
              "claim \"The peak is about 5 %.\": expected missed as the verdict, since peak is "
              "10.82 % and the claim means 4 to 6 %; found agrees");
    EXPECT_EQ(report.results["passes"], false);
    EXPECT_TRUE(contains(bytes_of(out() / "index.html"), "not what is measured"));
}

TEST_F(Figures, SeveralLeaveOnePageInTheOrderAskedFor) {
    for (const char* id : {"x1", "x2", "x3"}) add(id);
    const FigureReport report = run_figures(options("x3,x1"));
    ASSERT_EQ(report.results["figures"].size(), 2u);
    EXPECT_EQ(report.results["figures"][0]["id"], "x3");
    EXPECT_TRUE(fs::exists(out() / "x1/results.json"));
    EXPECT_FALSE(fs::exists(out() / "x2"));
    EXPECT_EQ(message(options("x1,x1")), "figure: expected each id once, found \"x1\" again");
    EXPECT_TRUE(contains(message(options("x1,x9")), "found \"x9\""));
}

TEST_F(Figures, ThePageShowsTextAsText) {
    add("x1", "", "<script>alert(1)</script>");
    run_figures(options("x1"));
    const std::string page = bytes_of(out() / "index.html");
    EXPECT_TRUE(contains(page, "A &lt;made-up&gt; figure &amp; more"));
    EXPECT_TRUE(contains(page, "other &lt;camera&gt;"));
    EXPECT_FALSE(contains(page, "<script"));
    EXPECT_FALSE(contains(page, "<made-up>"));
}

TEST_F(Figures, APublishedPictureIsShownBesideOurs) {
    add("x1");
    std::ofstream(folder_ / "from/x1/published.png") << "a scan";
    run_figures(options("x1"));
    EXPECT_EQ(bytes_of(out() / "published.png"), "a scan");
    EXPECT_TRUE(contains(bytes_of(out() / "index.html"), "src=\"published.png\""));
}

TEST_F(Figures, OnlyTheTimesDifferBetweenTwoRuns) {
    add("x1");
    add("x2");
    FigureOptions first = options("all", drawn), second = options("all", drawn);
    second.out = folder_ / "again";
    second.threads = 2;
    run_figures(first);
    run_figures(second);
    ASSERT_EQ(files_of(first.out), files_of(second.out));
    for (const std::string& file : files_of(first.out))
        if (file != "timing.json") {
            EXPECT_EQ(bytes_of(first.out / file), bytes_of(second.out / file)) << file;
        }
    const Json timing = JsonCursor::read_file(first.out / "timing.json").json();
    EXPECT_EQ(timing["figures"].size(), 2u);
    EXPECT_GE(timing["total_s"].get<double>(), timing["figures"][0]["write_s"].get<double>());
}

TEST_F(Figures, FormerResultsAreReplaced) {
    add("x1");
    add("x2");
    run_figures(options("all"));
    run_figures(options("x2"));
    EXPECT_FALSE(fs::exists(out() / "x1"));
    EXPECT_EQ(JsonCursor::read_file(out() / "results.json").at("id").string(), "x2");
    std::ofstream(out() / "mine.txt") << "x";
    EXPECT_TRUE(contains(message(options("x1")), "found \"mine.txt\" in it"));
}

TEST_F(Figures, AFileOfOnesOwnIsRunToo) {
    add("x1");
    FigureOptions own = options((folder_ / "from/x1/experiment.json").string());
    own.from.clear();
    EXPECT_EQ(run_figures(own).results["id"], "x1");
}

TEST_F(Figures, AnUnknownOneIsToldWithTheNearest) {
    add("9a");
    add("hanging_cube");
    EXPECT_EQ(message(options("hanging_cub")),
              "figure: expected all, a file that ends in .json, or one of 9a hanging_cube (did you "
              "mean \"hanging_cube\"?), found \"hanging_cub\"");
    EXPECT_EQ(message(options("none.json")), "none.json: expected a JSON file, found no such file");
    FigureOptions empty = options("9a");
    empty.from = folder_ / "nowhere";
    EXPECT_EQ(message(empty), (folder_ / "nowhere").string() +
                                  ": expected folders with an experiment.json, found none");
    EXPECT_TRUE(nothing_written());
}

TEST_F(Figures, NothingIsLeftWhenOneFails) {
    add("x1");
    add("x2");
    const auto failing_with = [&](void (*fail)(FigureResult&)) {
        FigureOptions given = options("all");
        given.run = [fail](const JsonCursor& json, const figures::RunOptions& run_options) {
            if (json.at("figure").string() != "x2") return numbers(json, run_options);
            FigureResult result = drawn(json, run_options);
            fail(result);
            return result;
        };
        const std::string said = message(given);
        EXPECT_TRUE(nothing_written()) << said;
        return said;
    };
    EXPECT_EQ(failing_with([](FigureResult&) { throw Error("x", "y", "z"); }),
              "x: expected y, found z");
    EXPECT_EQ(failing_with([](FigureResult& r) { r.charts[0].series.clear(); }),
              "chart \"curve\"/series: expected at least one, found none");
    EXPECT_EQ(failing_with([](FigureResult& r) { r.shapes[0].fixed = {7}; }),
              "objects/0/fixed: expected vertices 0..4, found 7");
    EXPECT_EQ(failing_with([](FigureResult& r) { r.shapes[0].name = "curve"; }),
              "shape \"curve\": expected a name that no other result has, found curve.png twice");
    EXPECT_EQ(failing_with([](FigureResult& r) { r.tables[0].name = "../up"; }),
              "table/name: expected letters, digits, _ and -, found \"../up\"");
    EXPECT_EQ(failing_with([](FigureResult& r) { r.tables[0].rows[1].pop_back(); }),
              "table \"numbers\"/rows/1: expected 2 numbers, found 1");
    EXPECT_EQ(failing_with([](FigureResult& r) { r.tables[0].row_names.pop_back(); }),
              "table \"numbers\"/row_names: expected 2 names, found 1");
    FigureOptions given = options("all", drawn);
    given.charts.gnuplot = "no-such-gnuplot";
    EXPECT_EQ(
        message(given),
        "run: no-such-gnuplot: not found; charts are drawn by it (Debian package gnuplot-nox)");
    EXPECT_TRUE(nothing_written());
}

TEST_F(Figures, AFailureStopsTheOthersAndIsTheOneTold) {
    add("x1");
    add("x2");
    FigureOptions given = options("all");
    given.threads = 2;
    given.run = [](const JsonCursor& json, const figures::RunOptions& run_options) {
        if (json.at("figure").string() == "x2") throw Error("x", "y", "z");
        for (;;) run_options.monitor.throw_if_stopped();  // until the other has failed
        return FigureResult{};
    };
    EXPECT_EQ(message(given), "x: expected y, found z");
    EXPECT_TRUE(nothing_written());
}

TEST_F(Figures, AWrongExperimentIsFoundBeforeAnyIsRun) {
    add("x1");
    FigureOptions given = options("x1");
    given.run = {};  // the experiments of the program
    EXPECT_TRUE(contains(message(given), "x1/experiment.json:/: expected the key \"kind\""))
        << message(given);
    EXPECT_TRUE(nothing_written());
}

TEST_F(Figures, ThePageSaysWhatPicturesShow) {
    add("x1");
    FigureOptions given = options("x1");
    given.run = [](const JsonCursor& json, const figures::RunOptions& run_options) {
        FigureResult result = drawn(json, run_options);
        result.shapes[0].shade = {0, 0, 0.5, 1, 1};
        result.shapes[0].shade_ends = {"softest", "stiffest"};
        result.shapes[0].outline.resize(2, 3);
        result.shapes[0].outline << 0, 0, 0, 1, 0, 2;
        return result;
    };
    run_figures(given);
    const std::string page = bytes_of(out() / "index.html");
    for (const char* part :
         {"held nodes", "outline at rest", "softest<i class=\"shade\"></i>stiffest"})
        EXPECT_TRUE(contains(page, part)) << part;
}

TEST_F(Figures, NothingIsLeftWhenStopped) {
    add("x1");
    EXPECT_THROW(run_figures(options("x1"), {.progress = {}, .stopped = [] { return true; }}),
                 Interrupted);
    // Asked while the experiment runs
    int asked = 0;
    EXPECT_THROW(
        run_figures(options("x1"), {.progress = {}, .stopped = [&] { return ++asked > 1; }}),
        Interrupted);
    EXPECT_TRUE(nothing_written());
}

TEST_F(Figures, ProgressGrowsToTheEnd) {
    add("x1");
    add("x2");
    std::vector<double> fractions;
    FigureOptions given = options("all");
    given.threads = 1;
    run_figures(given, {.progress = [&](double fraction,
                                        const std::string&) { fractions.push_back(fraction); },
                        .stopped = {}});
    ASSERT_GE(fractions.size(), 5u);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions[1], 0.25);
    EXPECT_EQ(fractions.back(), 1);
}

figures::Check within(double low, double high, const std::string& unit) {
    return {.name = "",
            .unit = unit,
            .measured = 0,
            .low = low,
            .high = high,
            .published = "",
            .note = ""};
}

TEST(FigurePage, NumbersAndRangesAreShort) {
    EXPECT_EQ(short_number(10.8249), "10.82");
    EXPECT_EQ(short_number(150000), "150000");
    EXPECT_EQ(short_number(1.23456e-9), "1.235e-09");
    EXPECT_EQ(short_number(NAN), "not a number");
    EXPECT_EQ(range_text(within(8, 13, "%")), "8 to 13 %");
    EXPECT_EQ(range_text(within(-kInfinity, 0.5, "")), "at most 0.5");
    EXPECT_EQ(range_text(within(2, kInfinity, "m")), "at least 2 m");
    EXPECT_EQ(range_text(within(0, 0, "")), "exactly 0");
    EXPECT_EQ(range_text(within(1.4211, 1.4213, "")), "1.4211 to 1.4213") << "not 1.421 to 1.421";
}

}  // namespace
}  // namespace risorius::figures
