// SPDX-License-Identifier: MIT
// Random facial movements: as often as asked, as independent as can be, and made again from their table.
#include "risorius/design/sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/design/conditions.h"
#include "temporary_folder.h"

namespace risorius::design {
namespace {

SampleOptions options_of(const std::string& text) {
    return read_sample(JsonCursor::from_json(Json::parse(text), "sample"));
}

/// The largest correlation of two units, and the counts of units, by definition.
struct Counted {
    std::map<std::string, int> of_unit;
    std::map<std::size_t, int> of_size;
    double largest_r = 0;
};

Counted counted(const std::vector<Trial>& trials) {
    Counted out;
    std::map<std::pair<std::string, std::string>, double> together;
    for (const Trial& trial : trials) {
        ++out.of_size[trial.units.size()];
        for (const UnitCourse& a : trial.units) {
            ++out.of_unit[a.unit];
            for (const UnitCourse& b : trial.units) ++together[{a.unit, b.unit}];
        }
    }
    const auto n = static_cast<double>(trials.size());
    for (const auto& [a, count_a] : out.of_unit)
        for (const auto& [b, count_b] : out.of_unit) {
            if (a <= b) continue;
            const double p = count_a / n, q = count_b / n;
            out.largest_r = std::max(out.largest_r, std::abs(together[{a, b}] / n - p * q) /
                                                        std::sqrt(p * (1 - p) * q * (1 - q)));
        }
    return out;
}

TEST(Sample, UnitsAreAsOftenAsAskedAndIndependent) {
    const SampleOptions options = options_of(R"({"units": "face41", "trials": 2400})");
    ASSERT_EQ(options.units.size(), 41u);
    SampleOptions plain = options;
    plain.candidates = 1;
    for (const unsigned seed : {1U, 2U, 3U}) {
        const std::vector<Trial> trials = sampled_trials(options, seed);
        ASSERT_EQ(trials.size(), 2400u);
        const Counted balanced = counted(trials);
        ASSERT_EQ(balanced.of_unit.size(), 41u);
        double sum = 0;
        for (const auto& [unit, count] : balanced.of_unit) sum += count;
        const double mean = sum / 41, p = mean / 2400, sd = std::sqrt(2400 * p * (1 - p));
        EXPECT_NEAR(mean, 2400 * 3.5 / 41, 3 * std::sqrt(2400 * 35.0 / 12) / 41);
        for (const auto& [unit, count] : balanced.of_unit)
            EXPECT_NEAR(count, mean, sd) << unit << ": 3 sd are asked for, balanced draws keep 1";
        ASSERT_EQ(balanced.of_size.size(), 6u);
        for (const auto& [size, count] : balanced.of_size)
            EXPECT_NEAR(count, 400, 3 * std::sqrt(400 * 5 / 6.0)) << size;
        EXPECT_LT(balanced.largest_r, 0.03);
        EXPECT_NEAR(balance_of(trials, options).largest_correlation, balanced.largest_r, 1e-9);
        EXPECT_GT(counted(sampled_trials(plain, seed)).largest_r, 0.05) << "plain draws";
    }
}

TEST(Sample, LongerOnesBeginAsShorterOnes) {
    const SampleOptions all = options_of(R"({"units": ["AU1", "AU2", "AU4", "AU12"], "trials": 50,
        "active": [2, 2], "active_law": "binomial", "exclusive": [["AU1", "AU4"]]})");
    SampleOptions some = all;
    some.trials = 20;
    const std::vector<Trial> long_one = sampled_trials(all, 5), short_one = sampled_trials(some, 5);
    for (std::size_t i = 0; i < short_one.size(); ++i)
        EXPECT_EQ(short_one[i].units, long_one[i].units) << i;
    EXPECT_NE(sampled_trials(all, 6)[0].units, long_one[0].units);
    for (const Trial& trial : long_one) {
        ASSERT_EQ(trial.units.size(), 2u);
        EXPECT_FALSE(trial.units[0].unit == "AU1" && trial.units[1].unit == "AU4");
    }
}

TEST(Sample, CoursesAreWithinTheirRanges) {
    const SampleOptions options = options_of(R"({"units": "face41", "trials": 500})");
    double steep = 0, count = 0;
    for (const Trial& trial : sampled_trials(options, 1))
        for (const UnitCourse& course : trial.units) {
            EXPECT_GE(course.amplitude, 0.3);
            EXPECT_LE(course.amplitude, 1);
            EXPECT_GE(course.onset_latency_s, 0);
            EXPECT_LE(course.onset_latency_s, 0.5);
            EXPECT_GE(course.peak_latency_s - course.onset_latency_s, 0.15 - 1e-4);
            EXPECT_LE(course.peak_latency_s - course.onset_latency_s, 0.6 + 1e-4);
            EXPECT_GT(course.offset_latency_s, course.peak_latency_s);
            EXPECT_LE(course.offset_latency_s, 1.25);
            EXPECT_GE(course.deceleration, 1.2);
            EXPECT_LE(course.deceleration, 4);
            steep += std::log(course.acceleration);
            ++count;
            EXPECT_EQ(course.amplitude, std::round(1e4 * course.amplitude) / 1e4);
        }
    // Log-uniform: the mean of logarithms lies in the middle; its standard error is .35 / sqrt(1750)
    EXPECT_NEAR(steep / count, (std::log(1.2) + std::log(4.0)) / 2, 0.03);
    const UnitCourse course{"AU12", 0.8, 0.1, 0.5, 1.1, 2, 3};
    EXPECT_EQ(course.at(0.1), 0);
    EXPECT_NEAR(course.at(0.3), 0.4, 1e-12) << "half-way up";
    EXPECT_NEAR(course.at(0.5), 0.8, 1e-12);
    EXPECT_NEAR(course.at(0.8), 0.4, 1e-12);
    EXPECT_EQ(course.at(1.1), 0);
    const double dt = 1e-5;
    EXPECT_NEAR((course.at(0.3 + dt) - course.at(0.3 - dt)) / (2 * dt), 0.8 * 2 / 0.4, 1e-3)
        << "amplitude x acceleration / rise";
}

TEST(Sample, UnitAndItsHalfTogetherTakeTheLarger) {
    const Json script =
        with_units(Json::object(),
                   {{"AU12", 0.4, 0, 0.4, 1, 2, 2}, {"AU12.l", 0.9, 0.3, 0.6, 1, 2, 2}}, 1.25, "x");
    EXPECT_EQ(script.at("duration_s"), 1.25);
    EXPECT_FALSE(script.at("channels").contains("AU12"));
    const auto at = [&](const char* channel, double t) {
        double value = -1;
        for (const Json& key : script.at("channels").at(channel).at("keys"))
            if (std::abs(key.at(0).get<double>() - t) < 1e-6) value = key.at(1).get<double>();
        return value;
    };
    EXPECT_NEAR(at("AU12.l", 0.4), 0.4, 1e-6) << "the whole unit is larger here";
    EXPECT_NEAR(at("AU12.l", 0.6), 0.9, 1e-6);
    EXPECT_NEAR(at("AU12.r", 0.4), 0.4, 1e-6);
    EXPECT_NEAR(at("AU12.r", 1), 0, 1e-6);
    EXPECT_NE(message_of([&] {
                  with_units(script, {{"AU12", 1, 0, 1, 2, 2, 2}}, 2, "x");
              }).find("a script without duration_s"),
              std::string::npos);
}

TEST(Sample, TableAloneMakesItAgain) {
    const TemporaryFolder folder;
    Json json = Json::parse(R"({"format": "risorius-design", "version": 1, "name": "random",
        "sets": [{"name": "random", "clip": "${head}_${trial}",
            "factors": {"head": ["a", "b"]},
            "script": {"format": "risorius-script", "version": 1, "rig": "${head}", "fps": 30},
            "sample": {"units": "face41", "trials": 30}}]})");
    const auto conditions = [&] {
        std::ofstream(folder.path() / "design.json") << json.dump();
        return conditions_of(read_design(folder.path() / "design.json"));
    };
    const std::vector<Condition> drawn = conditions();
    ASSERT_EQ(drawn.size(), 60u);
    EXPECT_EQ(drawn[0].script.at("channels"), drawn[1].script.at("channels")) << "on both heads";
    std::ofstream table(folder.path() / "sample.tsv");
    table << "trial\tunit\tamplitude\tonset_latency_s\tpeak_latency_s\toffset_latency_"
             "s\tacceleration\t"
             "deceleration\n";
    for (const Condition& one : drawn)
        for (const UnitCourse& course : one.units) {
            table << one.clip.substr(1) << "\t" << course.unit;
            for (std::size_t k = 0; k < 6; ++k)
                table << "\t" << format_number(parameter(course, k));
            table << "\n";
        }
    table.close();
    json["sets"][0]["sample"] = {{"table", "sample.tsv"}};
    const std::vector<Condition> read = conditions();
    ASSERT_EQ(read.size(), 60u);
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(read[i].clip, drawn[i].clip);
        EXPECT_EQ(read[i].script, drawn[i].script) << read[i].clip;
    }
}

TEST(Sample, RefusesWhatCannotBeMeant) {
    const auto complaint = [](const std::string& text) {
        return message_of([&] { options_of(text); });
    };
    EXPECT_EQ(complaint(R"({"units": ["AU1"], "trials": 3})"),
              "sample:/units: expected two units or more, found [\"AU1\"]");
    EXPECT_NE(complaint(R"({"units": ["AU1", "AU1"], "trials": 3})").find("every unit once"),
              std::string::npos);
    EXPECT_EQ(complaint(R"({"units": ["AU1", "AU2"], "trials": 3})"),
              "sample:/units: expected 6 units or more, found 2");
    EXPECT_NE(
        complaint(R"({"units": "face41", "trials": 3, "length_s": 1})").find("latest peak, 1.1 s"),
        std::string::npos);
    EXPECT_NE(complaint(R"({"units": "face41", "trials": 3, "times": {"rise": [0.5, 0.2]}})")
                  .find("the lower end or more"),
              std::string::npos);
    const SampleOptions none =
        options_of(R"({"units": ["AU1", "AU2"], "active": [2, 2], "trials": 3,
                                              "exclusive": [["AU1", "AU2"]]})");
    EXPECT_NE(message_of([&] { sampled_trials(none, 1); }).find("too many that exclude each other"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::design
