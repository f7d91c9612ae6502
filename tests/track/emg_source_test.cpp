// SPDX-License-Identifier: MIT
// Electromyograms as input and simulated ones as output: what is read from where, and how much is lost on the way out and back.

#include "risorius/track/detail/emg_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "own_folder_test.h"
#include "risorius/track/simulated_emg.h"
#include "risorius/track/timeline.h"
#include "track/standard_tables.h"

namespace risorius::track {
namespace {

class EmgSource : public OwnFolderTest {};

const ChannelTable& channels() { return StandardTables::get().channels; }

ScriptDescription script_of(const std::string& parts) {
    return read_script(
        JsonCursor::from_json(
            Json::parse(
                R"({"format": "risorius-script", "version": 1, "rig": "r", "duration_s": 3, )" +
                parts + "}"),
            "script.json"),
        channels(), StandardTables::get().facs, StandardTables::get().expressions);
}

std::string refusal_of(const std::string& emg) {
    try {
        script_of("\"emg\": " + emg);
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

void write(const std::string& header, const std::vector<std::vector<double>>& columns) {
    std::ofstream out("emg_test.csv");
    out.precision(9);
    out << header << "\n";
    for (std::size_t i = 0; i < columns[0].size(); ++i)
        for (std::size_t c = 0; c < columns.size(); ++c)
            out << columns[c][i] << (c + 1 < columns.size() ? "," : "\n");
}

double excitation(const Timeline& timeline, const char* muscle, Side side, double t_s) {
    return timeline.at(t_s).excitation[channels().column(muscle, side)];
}

// Rises within 0.4 s, holds for 0.7 s and falls, twice.
double intended(double t) {
    const double rise = minimum_jerk((t - 0.5) / 0.4), fall = minimum_jerk((t - 1.3) / 0.4);
    const double again = minimum_jerk((t - 1.9) / 0.3) - minimum_jerk((t - 2.3) / 0.3);
    return 0.7 * (rise - fall) + again;
}

/// White noise at 1 kHz with the intended amplitude. The band from 20 to 450 Hz hardly filters it.
std::vector<double> raw_emg(double amplitude, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<double> samples(3000);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        double white = -6;  // twelve uniform numbers: variance 1
        for (int k = 0; k < 12; ++k) white += static_cast<double>(random()) / 4294967296.0;
        samples[i] = amplitude * intended(static_cast<double>(i) / 1000) * white + 0.01;
    }
    return samples;
}

TEST_F(EmgSource, RawSignalsBecomeTheExcitationThatMadeThem) {
    write("ZYG_L", {raw_emg(0.2, 1)});
    // Rectified noise of amplitude 0.2 has the mean 0.2 sqrt(2/pi). The band keeps 43/50 of its power.
    const double maximum = 0.2 * std::sqrt(2 / 3.14159265358979) * std::sqrt(0.86);
    const Timeline timeline(
        script_of(R"("emg": {"file": "emg_test.csv", "rate_hz": 1000, "maximum": {"ZYG_L": )" +
                  std::to_string(maximum) + R"(}, "channels": {"zygomaticus_major.l": "ZYG_L"}})"),
        channels());
    double squares = 0, max_at_rest = 0;
    for (int i = 0; i < 600; ++i) {
        const double t = 0.005 * i;
        const double u = excitation(timeline, "zygomaticus_major", Side::kLeft, t);
        squares += std::pow(u - intended(t), 2) / 600;
        if (t < 0.3) max_at_rest = std::max(max_at_rest, u);
    }
    EXPECT_LT(std::sqrt(squares),
              0.08);               // the fluctuation of noise that 6 Hz leaves
    EXPECT_LT(max_at_rest, 0.01);  // the offset of 0.01 is gone
    EXPECT_EQ(excitation(timeline, "zygomaticus_major", Side::kRight, 0.9), 0);
    EXPECT_EQ(excitation(timeline, "zygomaticus_major", Side::kLeft, 3.1), 0);
}

TEST_F(EmgSource, EnvelopesAreTakenAsTheyAreAndSourcesAddUp) {
    std::vector<double> time, a, b;
    for (int i = 0; i < 300; ++i) {
        time.push_back(2 + 0.01 * i);
        a.push_back(i < 200 ? 1 : 5);
        b.push_back(3);
    }
    write("t,a,b", {time, a, b});
    const Timeline timeline(script_of(R"("channels": {"frontalis_medial.l": {"keys": [[0, 0.25]]}},
                     "emg": {"file": "emg_test.csv", "time_column": "t", "envelope": true,
                             "maximum": {"a": 4}, "delay_s": -2,
                             "channels": {"zygomaticus_major": "a", "frontalis_medial.l": "b"}})"),
                            channels());
    EXPECT_DOUBLE_EQ(excitation(timeline, "zygomaticus_major", Side::kLeft, 1), 0.25);
    EXPECT_DOUBLE_EQ(excitation(timeline, "zygomaticus_major", Side::kRight, 1), 0.25);
    EXPECT_DOUBLE_EQ(excitation(timeline, "zygomaticus_major", Side::kLeft, 2.5), 1);
    // The maximum of b is its own largest value; the sum with 0.25 is limited to 1.
    EXPECT_DOUBLE_EQ(excitation(timeline, "frontalis_medial", Side::kLeft, 1), 1);
}

TEST_F(EmgSource, AClockThatLiesOutsideOfTheScriptIsNamedAndCanBeginAtItsFirstRow) {
    std::vector<double> time, a;
    for (int i = 0; i < 500; ++i) {
        time.push_back(5000 + 0.01 * i);
        a.push_back(i < 100 ? 0 : 1);
    }
    write("t,a", {time, a});
    const std::string rest = R"("envelope": true, "channels": {"zygomaticus_major": "a"})";
    EXPECT_EQ(
        refusal_of(R"({"file": "emg_test.csv", "time_column": "t", )" + rest + "}"),
        "script.json:/emg: expected a recording with samples in the script, which lasts from 0 "
        "to 3 s, found emg_test.csv from 5000 s to 5004.99 s; \"time_origin\": \"first_row\" "
        "lets its first row be at 0 s");
    const ScriptDescription script = script_of(
        R"("emg": {"file": "emg_test.csv", "time_column": "t", "time_origin": "first_row", )" +
        rest + "}");
    EXPECT_EQ(script.notes,
              std::vector<std::string>{"emg_test.csv: lasts until 4.99 s, after the end "
                                       "of the script at 3 s"});
    const Timeline timeline(script, channels());
    EXPECT_EQ(excitation(timeline, "zygomaticus_major", Side::kLeft, 0.5), 0);
    EXPECT_EQ(excitation(timeline, "zygomaticus_major", Side::kLeft, 2), 1);
    EXPECT_EQ(
        refusal_of(R"({"file": "emg_test.csv", "rate_hz": 100, "time_origin": "first_row", )" +
                   rest + "}"),
        "script.json:/emg/time_origin: expected no such key beside \"rate_hz\", found "
        "\"first_row\"");
}

TEST_F(EmgSource, ValuesThatAreMissingForAMomentAreBridgedWithANote) {
    std::ofstream out("emg_test.csv");
    out << "a\n";
    for (int i = 0; i < 300; ++i) out << (i == 150 || i == 151 ? "n/a" : "+1.5e+00") << "\n";
    out.close();
    const ScriptDescription script = script_of(
        R"("emg": {"file": "emg_test.csv", "rate_hz": 100, "envelope": true,
                   "channels": {"zygomaticus_major": "a"}})");
    EXPECT_EQ(script.notes, std::vector<std::string>{
                                "emg_test.csv: 2 values of \"a\" are missing and bridged, at "
                                "most 0.02 s in a row"});
    EXPECT_EQ(excitation(Timeline(script, channels()), "zygomaticus_major", Side::kLeft, 1.505), 1);
}

TEST_F(EmgSource, RestIsTakenOff) {
    std::vector<double> a(400, 0.2);
    for (std::size_t i = 200; i < 400; ++i) a[i] = 1.2;
    write("a", {a});
    const Timeline timeline(
        script_of(R"("emg": {"file": "emg_test.csv", "rate_hz": 200, "envelope": true,
                             "rest_percentile": 10, "channels": {"mentalis": "a"}})"),
        channels());
    EXPECT_EQ(excitation(timeline, "mentalis", Side::kLeft, 0.5), 0);
    EXPECT_DOUBLE_EQ(excitation(timeline, "mentalis", Side::kLeft, 1.5), 1);
}

TEST_F(EmgSource, WhatCannotBeReadIsRefusedByPlace) {
    write("ZYG,MASS", {std::vector<double>(500, 0.1), std::vector<double>(500, 0.0)});
    const auto emg = [](const std::string& more) {
        return refusal_of(R"({"file": "emg_test.csv", "channels": {"zygomaticus_major": "ZYG"}, )" +
                          more + "}");
    };
    EXPECT_EQ(emg(R"("rate_hz": 1000, "band_pass_hz": [20, 600])"),
              "script.json:/emg/band_pass_hz/1: expected a frequency in (0, 500) Hz, half the rate "
              "at most, found 600");
    EXPECT_EQ(
        emg(R"("rate_hz": 800)"),
        "script.json:/emg: expected \"band_pass_hz\" below 400 Hz, half the rate, found none, "
        "which means up to 450 Hz");
    EXPECT_EQ(emg(R"("rate_hz": 1000, "band_pass_hz": [200, 20])"),
              "script.json:/emg/band_pass_hz: expected [lowest, highest], found [200,20]");
    EXPECT_EQ(emg(R"("rate_hz": 2000)"),
              "emg_test.csv: expected 668 samples or more for these filters, found 500");
    EXPECT_EQ(emg(R"("rate_hz": 1000, "time_column": "t")"),
              "script.json:/emg: expected either \"rate_hz\" or \"time_column\", found both");
    EXPECT_EQ(emg(R"("time_column": "t")"),
              "script.json:/emg/time_column: expected a column of emg_test.csv: \"ZYG\" \"MASS\", "
              "found \"t\"");
    EXPECT_EQ(emg(R"("rate_hz": 1000, "envelope": true, "notch_hz": 50)"),
              "script.json:/emg/notch_hz: expected no such key beside \"envelope\", found 50");
    EXPECT_EQ(emg(R"("rate_hz": 1000, "order": 3)"),
              "script.json:/emg/order: expected an even order, found 3");
    EXPECT_EQ(emg(R"("rate_hz": 1000, "maximum": {"ZYGO": 1})"),
              "script.json:/emg/maximum/ZYGO: expected a column of emg_test.csv, found \"ZYGO\"");
    EXPECT_EQ(emg(R"("rate_hz": 1000, "envelope": true, "maximum": {"ZYG": -1})"),
              "script.json:/emg/maximum/ZYG: expected a maximum above the envelope at rest, 0, "
              "found -1");
    EXPECT_EQ(
        emg(R"("rate_hz": 900, "notch_hz": 1e-12, "band_pass_hz": [20, 400], "maximum": {"ZYG": 1})"),
        "script.json:/emg: expected filters and values whose envelope is finite, found others "
        "(a frequency near 0?)");
    EXPECT_NE(emg(R"("rate_hz": 1000, "lowpass_hz": 6)").find("did you mean \"low_pass_hz\""),
              std::string::npos);
    const auto of = [](const std::string& assigned) {
        return refusal_of(R"({"file": "emg_test.csv", "rate_hz": 1000, "channels": )" + assigned +
                          "}");
    };
    EXPECT_EQ(of(R"({"mentali": "MASS"})"),
              "script.json:/emg/channels/mentali: expected a muscle of the rig (did you mean "
              "\"mentalis\"?), found \"mentali\"");
    EXPECT_EQ(of(R"({"mentalis": "MENT"})"),
              "script.json:/emg/channels/mentalis: expected a column of emg_test.csv: \"ZYG\" "
              "\"MASS\", found \"MENT\"");
    EXPECT_EQ(of(R"({"mentalis": "MASS"})"),  // silent throughout
              "script.json:/emg/channels/mentalis: expected a maximum above the envelope at rest, "
              "0, found 0");
    EXPECT_EQ(refusal_of(R"({"file": "none.csv", "rate_hz": 1000, "channels": {}})"),
              "script.json:/emg/file: expected an existing file, found \"none.csv\"");
}

TEST(SimulatedEmg, IsTheSmoothedExcitationWithoutDelay) {
    const Timeline timeline(
        script_of(R"("channels": {"zygomaticus_major.l": {"keys": [[0.99999, 0], [1, 0.8]],
                                                          "interpolation": "step"}})"),
        channels());
    SimulatedEmg emg(channels(), [&](double t) { return timeline.at(t); });
    const int column = channels().column("zygomaticus_major", Side::kLeft);
    EXPECT_NEAR(emg.at(0.5)[column], 0, 1e-6);
    EXPECT_NEAR(emg.at(1 - 0.5 / 240)[column], 0.4, 1e-3);  // half way, at the time of the step
    EXPECT_NEAR(emg.at(1.5)[column], 0.8, 1e-6);
    for (double t = 0; t < 2; t += 0.01) {
        EXPECT_GE(emg.at(t)[column], 0) << t;
        // The overshoot of both Butterworth passes is 4 %.
        EXPECT_LE(emg.at(t)[column], 0.8 * 1.06) << t;
    }
}

TEST(SimulatedEmg, DoesNotDependOnTheTimesAskedForBefore) {
    const Timeline timeline(script_of(R"("events": [{"blink": {}, "start_s": 0.8}])"), channels());
    const auto drive = [&](double t) { return timeline.at(t); };
    SimulatedEmg every(channels(), drive), once(channels(), drive), back(channels(), drive);
    Eigen::VectorXd last;
    for (int frame = 0; frame <= 60; ++frame) last = every.at(frame / 60.0);
    EXPECT_EQ(last, once.at(1));
    back.at(2.7);
    EXPECT_EQ(last, back.at(1));
}

TEST(SimulatedEmg, RestingToneIsActivityAndABlinkSilencesIt) {
    const Timeline timeline(
        script_of(R"("channels": {"levator_palpebrae_superioris": {"keys": [[1, 0], [1.5, -1]]}})"),
        channels());
    SimulatedEmg emg(channels(), [&](double t) { return timeline.at(t); });
    const int levator = channels().column("levator_palpebrae_superioris", Side::kLeft);
    EXPECT_NEAR(emg.at(0.2)[levator], 0.5, 1e-9);
    EXPECT_NEAR(emg.at(2.5)[levator], 0, 1e-9);
}

TEST_F(EmgSource, SimulatedEmgReadAgainGivesTheExcitationOfTheScript) {
    std::string keys;
    for (int i = 0; i <= 120; ++i)
        keys += (i ? ", [" : "[") + std::to_string(0.025 * i) + ", " +
                std::to_string(intended(0.025 * i)) + "]";
    const Timeline written(
        script_of(R"("channels": {"zygomaticus_major.l": {"keys": [)" + keys + "]}}"), channels());
    SimulatedEmg emg(channels(), [&](double t) { return written.at(t); });
    const int column = channels().column("zygomaticus_major", Side::kLeft);
    std::vector<double> time, envelope;
    for (int frame = 0; frame < 180; ++frame) {
        time.push_back(frame / 60.0);
        envelope.push_back(emg.at(frame / 60.0)[column]);
    }
    write("time_s,emg:zygomaticus_major.l", {time, envelope});
    const Timeline read(
        script_of(R"("emg": {"file": "emg_test.csv", "time_column": "time_s", "envelope": true,
                             "maximum": {"emg:zygomaticus_major.l": 1},
                             "channels": {"zygomaticus_major.l": "emg:zygomaticus_major.l"}})"),
        channels());
    double max = 0;
    for (double t = 0; t < 2.95; t += 0.005)
        max = std::max(
            max, std::abs(excitation(read, "zygomaticus_major", Side::kLeft, t) - intended(t)));
    EXPECT_LT(max, 0.03);  // what 6 Hz removes from a rise within 0.3 s
    EXPECT_GT(max, 0.001);
}

}  // namespace
}  // namespace risorius::track
