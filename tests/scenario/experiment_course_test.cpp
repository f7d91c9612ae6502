// SPDX-License-Identifier: MIT
// The order of an experiment's trials, its thresholds, its markers, and the ratings of a set. PsychoPy is a stand-in with an
// observer whose threshold is known; jsPsych is the real one, in a real browser.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "risorius/report/run_program.h"
#include "risorius/stimuli/batch.h"
#include "scenario/jspsych.h"
#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;
using report::run_program;

const fs::path kPrograms = kRoot / "tests/data/experiment";

/// A table with a heading, as rows of named cells.
std::vector<std::map<std::string, std::string>> table_of(const std::string& text, char separator) {
    std::istringstream in(text);
    std::string line;
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> out;
    while (std::getline(in, line)) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        std::istringstream cells(line + separator);
        std::vector<std::string> values;
        for (std::string cell; std::getline(cells, cell, separator);) values.push_back(cell);
        if (names.empty()) {
            names = values;
            continue;
        }
        out.emplace_back();
        for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i)
            out.back()[names[i]] = values[i];
    }
    return out;
}

/// Two expressions at six strengths, which every test asks for in its own way; the clips are made once.
class ExperimentCourse : public testing::Test {
  protected:
    static void SetUpTestSuite() { folder = new Folder; }
    static void TearDownTestSuite() { delete folder; }

    /// Makes the set with these keys of `experiment` and `triggers`.
    static stimuli::BatchReport make(const Json& experiment, const Json& triggers = Json::object(),
                                     const std::string& ratings = {}) {
        Json design = Json::parse(R"j({"format": "risorius-design", "version": 1, "name": "course",
            "clips": {"quality": "preview", "ending": "mp4"},
            "experiment": {"programs": ["psychopy"], "answers": {"a": "happiness", "f": "fear"},
                "correct": "expression", "fixation_s": 0.05, "jspsych_from": "../../node_modules"},
            "sets": [{"name": "two", "clip": "${expression}${strength}",
                "factors": {"expression": ["happiness", "fear"],
                            "strength": [0.1, 0.2, 0.3, 0.45, 0.65, 1]},
                "script": {"format": "risorius-script", "version": 1, "fps": 10, "duration_s": 0.4,
                    "events": [{"expression": "${expression}", "intensity": "${strength}",
                                "start_s": 0, "onset_s": 0.2, "hold_s": 0.1, "offset_s": 0.1}],
                    "view": {"width_px": 48, "height_px": 48, "antialiasing": 1}}}]})j");
        design["sets"][0]["script"]["rig"] = (kRoot / "rigs/adult/rig.json").string();
        design["experiment"].update(experiment);
        design["triggers"] = triggers;
        std::ofstream(*folder / "design.json") << design.dump();
        stimuli::BatchOptions options;
        options.design = *folder / "design.json";
        options.out = *folder / "set";
        options.workers = 2;
        if (!ratings.empty()) options.norms = ratings;
        return stimuli::make_batch(options);
    }
    static std::string refusal(const Json& experiment, const Json& triggers = Json::object()) {
        try {
            make(experiment, triggers);
        } catch (const std::exception& error) {
            return error.what();
        }
        return "accepted";
    }
    /// Plays experiment.py; returns the texts of what it wrote, by the end of their names.
    static std::map<std::string, std::string> play(const std::vector<std::string>& environment) {
        const fs::path here = *folder / "set/experiment";
        fs::remove_all(here / "data");
        std::vector<std::string> command{"env", "PYTHONPATH=" + (kPrograms / "stand_in").string(),
                                         "PYTHONDONTWRITEBYTECODE=1"};
        command.insert(command.end(), environment.begin(), environment.end());
        for (const std::string& word :
             {std::string("python3"), (here / "experiment.py").string(),
              std::string("--participant"), std::string("7"), std::string("--window")})
            command.push_back(word);
        const report::ProgramResult result = run_program(command);
        EXPECT_EQ(result.exit_code, 0) << result.output;
        std::map<std::string, std::string> out;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(here / "data", none)) {
            const std::string name = entry.path().filename().string();
            const std::size_t time = name.find('T');
            out[name.substr(name.find_first_of("._", time))] = text_of(entry.path());
        }
        return out;
    }
    static std::string missing_browser() { return missing_for_pages(folder->path()); }
    /// Plays a page with a server that saves nothing, and returns what is offered.
    static Json offered_by(const std::string& page, int run = 1) {
        const fs::path data = *folder / "offered.json";
        const report::ProgramResult played =
            run_program({"python3", (kPrograms / "play.py").string(), folder->path().string(),
                         "set/experiment/" + page, data.string(), "chromium", "--dead-save",
                         "--run=" + std::to_string(run)});
        EXPECT_EQ(played.exit_code, 0) << played.output;
        return Json::parse(text_of(data), nullptr, false);
    }
    static Folder* folder;
};
Folder* ExperimentCourse::folder = nullptr;

bool has_python() { return run_program({"python3", "--version"}).exit_code == 0; }

TEST_F(ExperimentCourse, HasPracticeBlocksCatchTrialsAndAScanner) {
    ASSERT_TRUE(make({{"blocks", 3}, {"practice", 2}, {"catch", 0.25}},
                     {{"response", true}, {"lsl", true}, {"wait_for", "5"}, {"dummy_volumes", 2}})
                    .complete);
    if (!has_python()) GTEST_SKIP() << "no python3 here";
    const auto files =
        play({"STAND_IN_TR=0.7", "STAND_IN_LSL=" + (*folder / "markers.txt").string()});
    const auto rows = table_of(files.at(".csv"), ',');
    ASSERT_EQ(rows.size(), 17u) << files.at(".csv");
    std::map<std::string, int> kinds, blocks;
    for (const auto& row : rows) {
        ++kinds[row.at("kind")];
        ++blocks[row.at("block")];
        const bool is_catch = row.at("kind") == "catch";
        EXPECT_EQ(row.at("key"), is_catch ? "space" : "a");
        EXPECT_EQ(row.at("codes").find(" 253@") != std::string::npos, is_catch) << row.at("codes");
        EXPECT_EQ(row.at("codes").find(" 6@") != std::string::npos, !is_catch) << row.at("codes");
        if (is_catch) {
            EXPECT_EQ(row.at("correct"), "1");
            EXPECT_GT(std::stod(row.at("response_time")), 0.4);
        } else {
            EXPECT_EQ(row.at("correct"), row.at("value_expression") == "happiness" ? "1" : "0");
        }
    }
    EXPECT_EQ(kinds, (std::map<std::string, int>{{"practice", 2}, {"trial", 12}, {"catch", 3}}));
    EXPECT_EQ(blocks, (std::map<std::string, int>{{"0", 2}, {"1", 5}, {"2", 5}, {"3", 5}}));

    // Pulses of the scanner are events, from the third on, which is time 0; all in the order of time.
    double before_s = -1;
    int pulses = 0;
    for (const auto& event : table_of(files.at("_events.tsv"), '\t')) {
        const double onset_s = std::stod(event.at("onset"));
        EXPECT_GE(onset_s, before_s);
        before_s = onset_s;
        if (event.at("trial_type") == "pulse")
            EXPECT_NEAR(onset_s, 0.7 * pulses++, 1e-4);
        else
            EXPECT_TRUE(fs::exists(*folder / "set/stimuli" / event.at("stim_file")));
    }
    EXPECT_GT(pulses, 10);
    const Json about = Json::parse(files.at("_events.json"));
    for (const char* column : {"onset", "block", "kind"}) EXPECT_TRUE(about.contains(column));

    // Markers of the Lab Streaming Layer: the same codes, with what they stand for
    std::istringstream markers(text_of(*folder / "markers.txt"));
    std::string line;
    std::getline(markers, line);
    EXPECT_EQ(line, "course Markers 1 0 string risorius-course");
    std::map<std::string, int> events;
    while (std::getline(markers, line)) {
        const Json sample = Json::parse(line.substr(line.find('{')));
        EXPECT_NE(sample.at("code"), 0);
        ++events[sample.at("event").get<std::string>()];
        if (sample.at("event") == "clip_on") {
            EXPECT_EQ(sample.at("code"), 1);
        }
    }
    EXPECT_EQ(events["clip_on"], 17);
    EXPECT_EQ(events["response"], 14);
    EXPECT_EQ(events["catch"], 3);
    EXPECT_EQ(events["practice"], 1);
    EXPECT_EQ(events["block"], 3);
    EXPECT_EQ(events["pause"], 3);
    EXPECT_EQ(events["scanner"], 1);
}

// An observer is right in 82 % of trials at .35 of the strength; QUEST must find that, and not the middle of the levels (.32 in log10 of
// .1 to 1) for two others.
TEST_F(ExperimentCourse, FindsTheThresholdOfAnObserverByQuest) {
    ASSERT_TRUE(make({{"method", "quest"},
                      {"over", "strength"},
                      {"series_by", Json::array()},
                      {"trials", 80}})
                    .complete);
    if (!has_python()) GTEST_SKIP() << "no python3 here";
    std::map<double, double> found;
    for (const double threshold : {0.2, 0.35, 0.7}) {
        const auto files = play({"STAND_IN_OBSERVER=" + std::to_string(threshold)});
        const auto rows = table_of(files.at(".csv"), ',');
        EXPECT_EQ(rows.size(), 80u);
        std::set<std::string> shown;
        for (const auto& row : rows) shown.insert(row.at("stim_id"));
        EXPECT_GT(shown.size(), 3u) << "clips of both expressions near the threshold";
        const auto thresholds = table_of(files.at("_thresholds.csv"), ',');
        ASSERT_EQ(thresholds.size(), 1u);
        EXPECT_EQ(thresholds[0].at("series"), "all");
        EXPECT_EQ(thresholds[0].at("trials"), "80");
        found[threshold] = std::stod(thresholds[0].at("threshold"));
        EXPECT_NEAR(std::log10(found[threshold] / threshold), 0,
                    3 * std::stod(thresholds[0].at("sd_log10")));
        EXPECT_LT(std::stod(thresholds[0].at("sd_log10")), 0.06);
    }
    EXPECT_LT(found[0.2], found[0.35]);
    EXPECT_LT(found[0.35], found[0.7]);
}

TEST_F(ExperimentCourse, FindsThresholdAndSlopeByQuestPlus) {
    ASSERT_TRUE(make({{"method", "questplus"},
                      {"over", "strength"},
                      {"series_by", Json::array()},
                      {"trials", 100}})
                    .complete);
    if (!has_python()) GTEST_SKIP() << "no python3 here";
    for (const double threshold : {0.2, 0.35, 0.7}) {
        const auto files = play({"STAND_IN_OBSERVER=" + std::to_string(threshold)});
        EXPECT_EQ(table_of(files.at(".csv"), ',').size(), 100u);
        const auto found = table_of(files.at("_thresholds.csv"), ',');
        ASSERT_EQ(found.size(), 1u);
        EXPECT_EQ(found[0].at("method"), "questplus");
        const double sd = std::stod(found[0].at("sd_log10"));
        EXPECT_NEAR(std::log10(std::stod(found[0].at("threshold")) / threshold), 0, 3 * sd);
        EXPECT_LT(sd, 0.08);
        // The observer's slope is 3.5. So few levels tell only that it is neither flat nor a step.
        EXPECT_GT(std::stod(found[0].at("slope")), 1.5);
        EXPECT_LT(std::stod(found[0].at("slope")), 8);
        EXPECT_LT(std::stod(found[0].at("lapse")), 0.05);
    }
}

// The class that a page has is that of experiment.py: the same levels in the same trials.
TEST_F(ExperimentCourse, OfJsPsychAsksAsPsychoPyDoesByQuestPlus) {
    const Json course{
        {"programs", {"psychopy", "jspsych"}}, {"method", "questplus"}, {"over", "strength"},
        {"series_by", Json::array()},          {"trials", 8},           {"catch", 0.25}};
    ASSERT_TRUE(make(course, {{"response", true}}).complete);
    if (const std::string missing = missing_browser(); !missing.empty()) GTEST_SKIP() << missing;
    const fs::path here = *folder / "set/experiment";
    const std::string page = text_of(here / "index.html");
    const std::size_t begin = page.find("class QuestPlus {"), end = page.find("\n}\n", begin);
    ASSERT_NE(end, std::string::npos);
    std::ofstream(*folder / "quest.js")
        << page.substr(begin, end - begin + 3)
        << "const quest = new QuestPlus([-1, -0.7, -0.5, -0.3, -0.1, 0], 40, 0.5);\n"
           "for (let trial = 0; trial < 40; ++trial) {\n"
           "    const level = quest.next();\n"
           "    quest.answered(trial % 5 !== 2 || level > -0.3, level);\n"
           "    console.log(level, quest.mean(quest.atRight).toFixed(6));\n}\n";
    std::ofstream(*folder / "quest.py")
        << "import experiment\n"
           "quest = experiment.QuestPlus([-1, -0.7, -0.5, -0.3, -0.1, 0], 40, 0.5)\n"
           "for trial in range(40):\n"
           "    level = next(quest)\n"
           "    quest.addResponse(int(trial % 5 != 2 or level > -0.3), intensity=level)\n"
           "    print(level, f'{quest.mean():.6f}')\n";
    const report::ProgramResult js = run_program({"node", (*folder / "quest.js").string()});
    const report::ProgramResult py =
        run_program({"env", "PYTHONPATH=" + (kPrograms / "stand_in").string() + ":" + here.string(),
                     "PYTHONDONTWRITEBYTECODE=1", "python3", (*folder / "quest.py").string()});
    ASSERT_EQ(js.exit_code, 0) << js.output;
    ASSERT_EQ(py.exit_code, 0) << py.output;
    EXPECT_EQ(js.output, py.output);

    const Json left = offered_by("index.html", 2);
    ASSERT_TRUE(left.is_object()) << left;
    const auto of_run = [&](const std::string& name) {
        return left.at("files").at("sub-7_task-course_run-2_" + name).get<std::string>();
    };
    const auto found = table_of(of_run("thresholds.csv"), ',');
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].at("trials"), "8");
    EXPECT_GT(std::stod(found[0].at("threshold")), 0.05);
    const auto dots = table_of(of_run("catch.csv"), ',');
    EXPECT_EQ(dots.at(0).at("catch_trials"), "2");
    EXPECT_EQ(dots.at(0).at("hits"), "2");
    EXPECT_EQ(dots.at(0).at("false_alarms"), "0");
    // Codes as the table of triggers has them, and 6 for an answer
    int answers = 0;
    for (const Json& trial : left.at("kept").at(0)) {
        if (trial.value("task", "") != "answer") continue;
        ++answers;
        EXPECT_EQ(trial.at("run"), 2);
        const auto codes = trial.at("codes").get<std::string>();
        EXPECT_EQ(codes.find("1@0.0000 "), 0u) << codes;
        EXPECT_NE(codes.find(" 4@0.4000 6@"), std::string::npos) << codes;
    }
    EXPECT_GE(answers, 8);
}

TEST_F(ExperimentCourse, CountsPressesWithoutARedDot) {
    ASSERT_TRUE(make({{"catch", 0.25}}).complete);
    if (!has_python()) GTEST_SKIP() << "no python3 here";
    const auto files = play({"STAND_IN_ALARMS=4"});
    int alarms = 0;
    for (const auto& row : table_of(files.at(".csv"), ',')) {
        EXPECT_EQ(row.at("kind") == "catch" && row.at("false_alarm") == "1", false);
        alarms += row.at("false_alarm") == "1";
    }
    EXPECT_EQ(alarms, 3) << "in every fourth of twelve trials";
    EXPECT_EQ(files.at("_catch.csv"),
              "catch_trials,hits,other_trials,false_alarms\r\n3,3,12,3\r\n");
    for (const auto& event : table_of(files.at("_events.tsv"), '\t'))
        EXPECT_TRUE(event.at("false_alarm") == "0" || event.at("false_alarm") == "1");
    // The norms of the set count them, too
    fs::path data;
    for (const auto& entry : fs::directory_iterator(*folder / "set/experiment/data"))
        if (const std::string name = entry.path().filename().string();
            name.ends_with(".csv") && !name.ends_with("_catch.csv"))
            data = entry.path();
    ASSERT_TRUE(make({{"catch", 0.25}}, Json::object(), data.string()).complete);
    const Json norms = Json::parse(text_of(*folder / "set/norms/norms.json"));
    EXPECT_EQ(norms.at("catch").at("false_alarms"), 3);
    EXPECT_EQ(norms.at("catch").at("hits"), 3);
    EXPECT_EQ(norms.at("answers").at("happiness").at("shown"), 6) << "catch trials are no ratings";
}

TEST_F(ExperimentCourse, HasAStaircaseForEachExpressionOverWhatIsSeen) {
    ASSERT_TRUE(make({{"method", "staircase"}, {"trials", 60}}).complete);
    if (!has_python()) GTEST_SKIP() << "no python3 here";
    // The levels are the shares that the set's table has.
    std::map<std::string, std::string> seen;
    for (const auto& row : table_of(text_of(*folder / "set/stimuli/stimuli.tsv"), '\t'))
        seen["stim-" + row.at("stimulus_id").substr(row.at("stimulus_id").rfind('-') + 1)] =
            row.at("seen_share");
    const auto conditions = table_of(text_of(*folder / "set/experiment/conditions.csv"), ',');
    ASSERT_EQ(conditions.size(), 12u);
    for (const auto& row : conditions) {
        EXPECT_NEAR(std::stod(row.at("level")), std::stod(seen.at("stim-" + row.at("stim_id"))),
                    1e-6);
        EXPECT_EQ(row.at("series"), row.at("value_expression"));
    }
    const auto files = play({"STAND_IN_OBSERVER=0.5"});
    const auto thresholds = table_of(files.at("_thresholds.csv"), ',');
    ASSERT_EQ(thresholds.size(), 2u);
    for (const auto& row : thresholds) {
        EXPECT_EQ(row.at("trials"), "60");
        EXPECT_NEAR(std::log10(std::stod(row.at("threshold")) / 0.5), 0, 0.2) << row.at("series");
    }
    // The first trial of a series is its strongest clip; an observer who is right goes down from there.
    std::map<std::string, std::string> first;
    for (const auto& row : table_of(files.at(".csv"), ','))
        first.emplace(row.at("series"), row.at("value_strength"));
    EXPECT_EQ(first, (std::map<std::string, std::string>{{"fear", "1"}, {"happiness", "1"}}));
}

TEST_F(ExperimentCourse, IsRefusedWhereItCannotBeRun) {
    const std::string design = (*folder / "design.json").string();
    EXPECT_EQ(refusal({{"method", "quest"}, {"correct", nullptr}}).find("accepted"),
              std::string::npos);
    EXPECT_EQ(refusal({{"method", "quest"}, {"programs", {"jspsych"}}}),
              design +
                  ":/experiment/method: expected \"constant\" or \"questplus\" for jspsych, which "
                  "has no other method, found \"quest\"");
    EXPECT_EQ(refusal({{"trials", 20}}), design +
                                             ":/experiment/trials: expected none without a "
                                             "\"method\" that chooses its clips, found 20");
    EXPECT_EQ(refusal({{"method", "quest"}, {"over", "expression"}}),
              design +
                  ":/experiment/over: expected a parameter with numbers above 0 in all clips, "
                  "found \"expression\", \"happiness\" in happiness0p1");
    EXPECT_EQ(
        refusal({{"method", "quest"}, {"series_by", {"strength"}}, {"over", "strength"}})
            .find(design + ":/experiment/method: expected two levels at least in each series, "),
        0u);
    EXPECT_EQ(
        refusal({{"answers", {{"5", "happiness"}, {"f", "fear"}}}}, {{"wait_for", "5"}}),
        design +
            ":/experiment/answers/5: expected a key that the pulses of the scanner do not press, "
            "found \"happiness\"");
    EXPECT_EQ(refusal(Json::object(), {{"dummy_volumes", 2}}),
              design + ":/triggers/dummy_volumes: expected \"wait_for\" beside it, found none");
}

TEST_F(ExperimentCourse, OfJsPsychHasPracticeBlocksCatchTrialsAndEvents) {
    ASSERT_TRUE(make({{"programs", {"jspsych"}}, {"blocks", 2}, {"practice", 2}, {"catch", 0.17}})
                    .complete);
    if (const std::string missing = missing_browser(); !missing.empty()) GTEST_SKIP() << missing;
    const Json left = offered_by("index.html");
    ASSERT_TRUE(left.is_object()) << left;
    const auto events = table_of(
        left.at("files").at("sub-7_task-course_run-1_events.tsv").get<std::string>(), '\t');
    std::map<std::string, int> kinds;
    double before_s = 0;
    for (const auto& event : events) {
        const double onset_s = std::stod(event.at("onset"));
        EXPECT_GT(onset_s, before_s);
        before_s = onset_s;
        EXPECT_EQ(event.at("duration"), "0.4000");
        ++kinds[event.at("kind") + event.at("block")];
        if (event.at("kind") != "catch") {
            EXPECT_EQ(event.at("answer"), "happiness");
            EXPECT_EQ(event.at("correct"),
                      event.at("stimulus_id").find("happiness") != std::string::npos ? "1" : "0");
            EXPECT_GT(std::stod(event.at("response_time")), 0.2);
        } else {
            EXPECT_EQ(event.at("correct"), "1") << "the red dot was seen";
        }
    }
    EXPECT_EQ(kinds["practice0"], 2);
    EXPECT_EQ(kinds["catch1"] + kinds["catch2"], 2);
    EXPECT_GE(kinds["trial1"] + kinds["trial2"], 12) << "and those that came once more";
    EXPECT_EQ(kinds["trial1"] + kinds["catch1"], 7);
}

TEST_F(ExperimentCourse, HasRatingsThatBecomeTheNormsOfTheSet) {
    ASSERT_TRUE(
        make({{"programs", {"rating"}}, {"scales", {"intensity", "naturalness"}}}).complete);
    if (const std::string missing = missing_browser(); !missing.empty()) GTEST_SKIP() << missing;
    const Json left = offered_by("rating.html");
    ASSERT_TRUE(left.is_object()) << left;
    EXPECT_EQ(left.at("file"), "ratings-7.csv");
    const auto csv = left.at("csv").get<std::string>();
    EXPECT_EQ(csv.substr(0, csv.find('\n')),
              "participant,stimulus_id,answer,intensity,naturalness,flag,rt");
    std::ofstream(*folder / "ratings.csv") << csv;
    EXPECT_EQ(make({{"programs", {"rating"}}, {"scales", {"intensity", "naturalness"}}},
                   Json::object(), (*folder / "ratings.csv").string())
                  .kept,
              12);
    int rows = 0;
    for (const auto& row : table_of(text_of(*folder / "set/stimuli/stimuli.tsv"), '\t')) {
        ++rows;
        EXPECT_EQ(row.at("norm_answer"), "fear") << "the last of two choices";
        EXPECT_EQ(row.at("norm_intensity"), "3");
        EXPECT_EQ(row.at("norm_naturalness"), "3");
    }
    EXPECT_EQ(rows, 12);
}

}  // namespace
}  // namespace risorius::scenario
