// SPDX-License-Identifier: MIT
// Reverse correlation: simulated observers, whose expressions are known, are asked.
#include "risorius/stimuli/reverse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "message_of.h"
#include "risorius/core/counter_rng.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_reader.h"
#include "risorius/track/script.h"
#include "temporary_folder.h"

namespace risorius::stimuli {
namespace {

namespace fs = std::filesystem;

/// What an observer has in mind: log odds of the answer for each unit at its mean amplitude.
using Template = std::map<std::string, double>;

std::vector<design::Trial> random_trials(int count) {
    const Json json{{"units", "face41"}, {"trials", count}};
    return design::sampled_trials(design::read_sample(JsonCursor::from_json(json, "sample")), 11);
}

double evidence(const Template& wanted, const design::Trial& trial) {
    constexpr double kMeanAmplitude = 0.65;
    double sum = 0;
    for (const design::UnitCourse& course : trial.units)
        if (const auto unit = wanted.find(course.unit); unit != wanted.end())
            sum += unit->second * course.amplitude / kMeanAmplitude;
    return sum;
}

/// Says yes when a trial shows what it has in mind, with a lapse in 5 % of the trials.
Observations asked(const std::vector<design::Trial>& trials, const Template& wanted, double bias,
                   std::uint64_t seed) {
    Observations out;
    out.trials = trials;
    std::set<std::string> units;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        for (const design::UnitCourse& course : trials[i].units) units.insert(course.unit);
        RandomSequence chance(seed * 1000003 + i);
        const bool lapse = chance.next() < 0.05;
        const double p = lapse ? 0.5 : 1 / (1 + std::exp(-bias - evidence(wanted, trials[i])));
        out.answers.push_back({0, static_cast<int>(i), chance.next() < p ? "yes" : "no"});
    }
    out.units.assign(units.begin(), units.end());
    out.participants = {"one"};
    return out;
}

std::set<std::string> found(const AnswerModel& model, UnitModel::Role role) {
    std::set<std::string> out;
    for (const UnitModel& unit : model.units)
        if (unit.role == role) out.insert(unit.unit);
    return out;
}

TEST(Reverse, FindsTheUnitsOfASimulatedObserver) {
    const std::vector<design::Trial> trials = random_trials(2400);
    const Template wanted{{"AU1", 1.5}, {"AU5", 1.5}, {"AU20", 1.5}, {"AU12.l", 1.5}};
    const Observations observations = asked(trials, wanted, -2.3, 1);
    const AnswerModel model = classification_model(observations, "yes", {});
    EXPECT_GT(model.given, 0.15 * 2400);
    EXPECT_LT(model.given, 0.23 * 2400);
    std::set<std::string> units;
    for (const auto& [unit, weight] : wanted) units.insert(unit);
    EXPECT_EQ(found(model, UnitModel::Role::kFacilitates), units);
    EXPECT_TRUE(found(model, UnitModel::Role::kInhibits).empty());
    EXPECT_NEAR(model.threshold_up, 0.066, 0.004);
    EXPECT_NEAR(model.threshold_down, -0.066, 0.008);
    int covered = 0;
    for (const UnitModel& unit : model.units) {
        EXPECT_LT(unit.r.low, unit.r.value);
        EXPECT_GT(unit.r.high, unit.r.value);
        // The answer's correlation by definition
        double n = 0, both = 0;
        for (const Observations::Answer& one : observations.answers)
            for (const design::UnitCourse& course :
                 trials[static_cast<std::size_t>(one.trial)].units)
                if (course.unit == unit.unit) {
                    ++n;
                    both += one.given == "yes";
                }
        const double p = n / 2400, q = model.given / 2400.0;
        EXPECT_NEAR(unit.r.value, (both / 2400 - p * q) / std::sqrt(p * (1 - p) * q * (1 - q)),
                    1e-12);
        const double true_weight = wanted.count(unit.unit) > 0 ? 1.5 : 0;
        EXPECT_NEAR(unit.weight.value, true_weight, 0.9) << unit.unit;
        covered += unit.weight.low <= true_weight && true_weight <= unit.weight.high;
    }
    EXPECT_GE(covered, 34) << "intervals of 95 % of 41 weights; lapses pull the large ones to 0";
    // The same numbers again, and others with another seed
    ClassificationOptions few;
    few.permutations = few.bootstraps = 100;
    const double once = classification_model(observations, "yes", few).units[0].r.low;
    EXPECT_EQ(classification_model(observations, "yes", few).units[0].r.low, once);
    few.seed = 2;
    EXPECT_NE(classification_model(observations, "yes", few).units[0].r.low, once);
}

TEST(Reverse, FindsWhatInhibitsAndWhenAUnitMatters) {
    const std::vector<design::Trial> trials = random_trials(4800);
    Observations observations = asked(trials, {{"AU4", -2.5}}, 0.5, 3);
    // Says yes to AU1 when it peaks early
    for (Observations::Answer& one : observations.answers)
        for (const design::UnitCourse& course : trials[static_cast<std::size_t>(one.trial)].units)
            if (course.unit == "AU1") one.given = course.peak_latency_s < 0.5 ? "yes" : "no";
    const AnswerModel model = classification_model(observations, "yes", {});
    EXPECT_EQ(found(model, UnitModel::Role::kInhibits).count("AU4"), 1u);
    for (const UnitModel& unit : model.units) {
        if (unit.role == UnitModel::Role::kNone) continue;
        ASSERT_EQ(unit.parameters.size(), 6u);
        if (unit.unit != "AU1") continue;
        EXPECT_TRUE(unit.parameters[2].tuned);
        EXPECT_LT(unit.parameters[2].r, -0.5);
        EXPECT_LT(unit.course().peak_latency_s, 0.6);
        EXPECT_FALSE(unit.parameters[5].tuned) << "the deceleration does not matter";
    }
}

TEST(Reverse, FindsNothingInRandomAnswers) {
    const std::vector<design::Trial> trials = random_trials(600);
    int any = 0;
    ClassificationOptions options;
    options.permutations = 400;
    options.bootstraps = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const AnswerModel model =
            classification_model(asked(trials, {}, -1.4, 100 + seed), "yes", options);
        any += !found(model, UnitModel::Role::kFacilitates).empty() ||
               !found(model, UnitModel::Role::kInhibits).empty();
    }
    // 5 % of 40; more than 6 have a probability of 1 %
    EXPECT_LE(any, 6);
}

TEST(Reverse, SixAnswersAtOnceHaveTheirUnits) {
    const std::vector<design::Trial> trials = random_trials(2400);
    const std::vector<Template> wanted{{{"AU6", 2}, {"AU12", 2}, {"AU25", 2}, {"AU13", 2}},
                                       {{"AU1", 2}, {"AU15", 2}, {"AU17", 2}, {"AU11", 2}},
                                       {{"AU4", 2}, {"AU7", 2}, {"AU23", 2}, {"AU24", 2}},
                                       {{"AU9", 2}, {"AU10", 2}, {"AU16", 2}, {"AU39", 2}},
                                       {{"AU5", 2}, {"AU20", 2}, {"AU26", 2}, {"AU38", 2}},
                                       {{"AU2", 2}, {"AU27", 2}, {"AU35", 2}, {"AU34", 2}}};
    Observations observations = asked(trials, {}, 0, 1);
    for (Observations::Answer& one : observations.answers) {
        RandomSequence chance(77777 + static_cast<std::uint64_t>(one.trial));
        const auto gumbel = [&] {
            return -std::log(-std::log(1e-12 + chance.next() * (1 - 2e-12)));
        };
        double best = gumbel() + 1;
        one.given = "other";
        for (std::size_t c = 0; c < wanted.size(); ++c) {
            const double value =
                gumbel() + evidence(wanted[c], trials[static_cast<std::size_t>(one.trial)]);
            if (value > best) {
                best = value;
                one.given = "answer " + std::to_string(c);
            }
        }
    }
    int right = 0, wrong = 0;
    ClassificationOptions options;
    options.bootstraps = 0;
    for (std::size_t c = 0; c < wanted.size(); ++c) {
        const AnswerModel model =
            classification_model(observations, "answer " + std::to_string(c), options);
        for (const std::string& unit : found(model, UnitModel::Role::kFacilitates))
            wanted[c].count(unit) > 0 ? ++right : ++wrong;
    }
    EXPECT_GE(right, 22);
    EXPECT_LE(wrong, 1);
}

/// A sample of a few trials, and answers of two people to it, as files.
class ReverseFiles : public testing::Test {
  protected:
    void SetUp() override {
        const std::vector<design::Trial> trials = random_trials(400);
        std::ofstream table(file("sample.tsv"));
        table << "trial\tstimulus_id\tunit";
        for (const std::string& name : design::course_parameters()) table << "\t" << name;
        table << "\tseen_mm\n";
        for (const design::Trial& trial : trials)
            for (const design::UnitCourse& course : trial.units) {
                table << trial.number << "\tstim-t" << trial.number << "\t" << course.unit;
                for (std::size_t k = 0; k < 6; ++k)
                    table << "\t" << format_number(design::parameter(course, k));
                table << "\t2.5\n";
            }
        std::ofstream answers(file("7.csv"));
        answers << "participant,stim_id,answer,reaction (s),intensity\n";
        std::ofstream others(file("8.tsv"));
        others << "participant\ttrial\tresponse\n";
        for (const design::Trial& trial : trials) {
            const bool smile = evidence({{"AU12", 1}}, trial) > 0;
            // A smile looks the stronger the larger and the earlier it is.
            double intensity = 5;
            for (const design::UnitCourse& course : trial.units)
                if (course.unit == "AU12")
                    intensity = 5 * course.amplitude - 2 * course.onset_latency_s;
            answers << "7,t" << trial.number << "," << (smile ? "happy" : "not so") << ",0.5,"
                    << (smile ? format_number(intensity) : "") << "\n";
            others << "8\t" << trial.number << "\t"
                   << (trial.number % 10 == 0 ? "n/a"
                       : smile                ? "happy"
                                              : "not so")
                   << "\n";
        }
    }
    fs::path file(const char* name) const { return folder_.path() / name; }
    static std::string text_of(const fs::path& path) {
        std::ifstream in(path);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    ReverseOptions options() const {
        ReverseOptions out;
        out.table = file("sample.tsv");
        out.responses = {file("7.csv"), file("8.tsv")};
        out.out = file("model");
        out.rig = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";
        out.by_participant = true;
        out.classification.permutations = out.classification.bootstraps = 200;
        return out;
    }

  private:
    TemporaryFolder folder_;
};

TEST_F(ReverseFiles, BecomeAnExpressionThatCanBePlayed) {
    const Json json = reverse_correlation(options());
    EXPECT_EQ(json, Json::parse(text_of(file("model/model.json"))));
    EXPECT_EQ(json.at("participants"), 2);
    ASSERT_EQ(json.at("answers").size(), 2u);
    const Json& happy = json.at("answers")[0];
    EXPECT_EQ(happy.at("answer"), "happy");
    EXPECT_EQ(happy.at("trials"), 400 + 360);
    bool found_it = false;
    for (const Json& unit : happy.at("units"))
        if (unit.at("unit") == "AU12") {
            found_it = true;
            EXPECT_EQ(unit.at("role"), "facilitates");
            EXPECT_NEAR(unit.at("r").at("value").get<double>(), 1, 1e-9);
            EXPECT_EQ(unit.at("found_in"), 2);
            const Json& course = unit.at("course");
            EXPECT_GT(course.at("amplitude").at("r_intensity").get<double>(), 0.8);
            EXPECT_LT(course.at("amplitude").at("p_intensity").get<double>(), 0.05);
            EXPECT_LT(course.at("onset_latency_s").at("r_intensity").get<double>(), 0);
            EXPECT_GT(course.at("deceleration").at("p_intensity").get<double>(), 0.05);
        }
    EXPECT_TRUE(found_it);
    for (const char* name : {"model_happy.json", "model_happy_low.json", "model_happy_high.json"}) {
        const Json script = Json::parse(text_of(file("model") / name));
        EXPECT_TRUE(script.at("channels").contains("AU12")) << name;
        EXPECT_EQ(track::read_script_header(JsonCursor::read_file(file("model") / name))
                      .rig_file.filename(),
                  "rig.json");
    }
    EXPECT_FALSE(fs::exists(file("model/model_notSo_low.json")))
        << "nothing facilitates the other answer in two thirds of the units";
    EXPECT_EQ(text_of(file("model/model.tsv")).rfind("answer\tunit\trole\tshown\tanswered\tr\t", 0),
              0u);
    const std::string page = text_of(file("model/index.html"));
    EXPECT_NE(page.find("AU12"), std::string::npos);
    // Its pictures: a smile begins at rest, and the ends of its interval differ.
    EXPECT_NE(page.find("<video src=\"model_happy.mp4\""), std::string::npos);
    media::VideoReader video(file("model/model_happy.mp4"));
    EXPECT_EQ(video.width_px(), 384);
    EXPECT_GT(video.frames(), 20);
    EXPECT_NE(video.frame(0).rgba, video.frame(video.frames() / 2).rgba);
    const Image strip = media::read_png(file("model/model_happy.png"));
    EXPECT_GT(strip.width_px, 6 * 192);
    EXPECT_GT(strip.height_px, 3 * 192);
    EXPECT_FALSE(fs::exists(file("model/model_notSo.mp4")));
}

TEST_F(ReverseFiles, AreRefusedWithTheirPlace) {
    ReverseOptions bad = options();
    bad.pictures = false;
    bad.answers = {"hapy"};
    EXPECT_NE(message_of([&] { reverse_correlation(bad); }).find("\"happy\""), std::string::npos);
    EXPECT_FALSE(fs::exists(file("model")));
    std::ofstream(file("7.csv")) << "participant,stim_id,answer\n7,t9999,happy\n";
    EXPECT_EQ(
        message_of([&] { reverse_correlation(options()); }).substr(file("7.csv").string().size()),
        ":2, participant: expected a stimulus_id, or without one a trial, of the sample, found "
        "\"t9999\"");
    std::ofstream(file("7.csv")) << "participant,stim_id\n7,t1\n";
    bad = options();
    bad.responses = {file("7.csv")};
    EXPECT_NE(message_of([&] { reverse_correlation(bad); }).find("answers in a column response"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::stimuli
