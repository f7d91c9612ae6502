// SPDX-License-Identifier: MIT
// Expressions have the times reported for people, and a higher intensity increases every part.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "risorius/track/script.h"
#include "risorius/track/timeline.h"
#include "track/standard_tables.h"

namespace risorius::track {
namespace {

const char* const kSeven[] = {"happiness", "sadness",  "anger",   "fear",
                              "disgust",   "surprise", "contempt"};

Timeline of(const std::string& expression, const std::string& more) {
    Json json = Json::parse(
        R"({"format": "risorius-script", "version": 1, "rig": "rig.json", "duration_s": 6})");
    json["events"] =
        Json::parse(R"([{"expression": ")" + expression + R"(", "start_s": 0.5)" + more + "}]");
    return Timeline(read_script(JsonCursor::from_json(json, "script.json"), tables().channels,
                                tables().facs, tables().expressions),
                    tables().channels);
}

TEST(Expressions, TakeTheTimesReportedForPeople) {
    // Onsets, s, after Schmidt et al. 2006 and reviews of dynamic stimuli. Offsets take 1.3 to 2 times as long.
    const std::map<std::string, std::pair<double, double>> onset{
        {"happiness", {0.4, 0.75}}, {"sadness", {0.6, 1.2}}, {"anger", {0.4, 0.8}},
        {"fear", {0.25, 0.5}},      {"disgust", {0.4, 0.7}}, {"surprise", {0.15, 0.35}},
        {"contempt", {0.2, 0.75}}};
    for (const char* name : kSeven) {
        const Expression& e = *tables().expressions.find(name);
        EXPECT_GE(e.onset_s, onset.at(name).first) << name;
        EXPECT_LE(e.onset_s, onset.at(name).second) << name;
        EXPECT_GE(e.offset_s / e.onset_s, 1.3) << name;
        EXPECT_LE(e.offset_s / e.onset_s, 2.0) << name;
        for (const ExpressionUnit& unit : e.parts.units)
            EXPECT_LE(unit.delay * e.onset_s, 0.2 + 1e-12) << name << " " << unit.use.unit;
    }
}

TEST(Expressions, ComeWithOneSmoothRiseOfSpeed) {
    for (const char* name : kSeven) {
        const double onset = tables().expressions.find(name)->onset_s;
        const Timeline timeline = of(name, "");
        double before = 0, speed_before = 0;
        int peaks = 0;
        for (double t = 0.5; t <= 0.5 + onset; t += onset / 100) {
            const double sum = timeline.at(t).excitation.cwiseAbs().sum();
            const double speed = sum - before;
            EXPECT_GE(speed, -1e-9) << name << " at " << t;
            peaks += speed < speed_before - 1e-9 && speed_before > 0 && peaks % 2 == 0;
            peaks += speed > speed_before + 1e-9 && peaks % 2 == 1;
            speed_before = speed;
            before = sum;
        }
        EXPECT_EQ(peaks, 1) << name;
    }
}

TEST(Expressions, OfHigherIntensityAreMoreOfEverything) {
    for (const char* name : kSeven) {
        Eigen::VectorXd before;
        for (const char* intensity : {"0.2", "0.4", "0.6", "0.8", "1.0"}) {
            const Eigen::VectorXd now =
                of(name, std::string(R"(, "hold_s": 1, "intensity": )") + intensity)
                    .at(0.6 + tables().expressions.find(name)->onset_s)
                    .excitation;
            EXPECT_GT(now.norm(), 0.05) << name;
            if (before.size() > 0) {
                EXPECT_TRUE((now.array().abs() >= before.array().abs() - 1e-12).all())
                    << name << " " << intensity;
            }
            before = now;
        }
    }
}

TEST(Expressions, AsymmetryWeakensOneSideByAtMostItsShare) {
    const int left = tables().column("zygomaticus_major.l"),
              right = tables().column("zygomaticus_major.r");
    const Drive even = of("happiness", "").at(1.3);
    EXPECT_EQ(even.excitation[left], even.excitation[right]);
    const Drive uneven = of("happiness", R"(, "asymmetry": 0.2)").at(1.3);
    const double weaker = std::min(uneven.excitation[left], uneven.excitation[right]);
    const double stronger = std::max(uneven.excitation[left], uneven.excitation[right]);
    EXPECT_EQ(stronger, even.excitation[left]);
    EXPECT_LE(weaker, 0.9 * stronger + 1e-12);
    EXPECT_GE(weaker, 0.8 * stronger - 1e-12);
}

}  // namespace
}  // namespace risorius::track
