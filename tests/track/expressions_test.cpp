// SPDX-License-Identifier: MIT
// Expressions have the times reported for people, and a higher intensity increases every part.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "message_of.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"
#include "risorius/track/unit_intensity.h"
#include "track/standard_tables.h"

namespace risorius::track {
namespace {

const char* const kSeven[] = {"happiness", "sadness",  "anger",   "fear",
                              "disgust",   "surprise", "contempt"};

ScriptDescription script_with(const std::string& expression, const std::string& more) {
    Json json = Json::parse(
        R"({"format": "risorius-script", "version": 1, "rig": "rig.json", "duration_s": 6})");
    json["events"] =
        Json::parse(R"([{"expression": ")" + expression + R"(", "start_s": 0.5)" + more + "}]");
    return read_script(JsonCursor::from_json(json, "script.json"), tables().channels, tables().facs,
                       tables().expressions);
}

Timeline of(const std::string& expression, const std::string& more) {
    return Timeline(script_with(expression, more), tables().channels);
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

TEST(Expressions, TakeTheTimesOfTheirManner) {
    const auto times = [](const std::string& expression, const std::string& more) {
        const ExpressionEvent event = script_with(expression, more).expressions.at(0);
        return std::array{event.onset_s, event.hold_s, event.offset_s};
    };
    const auto usual = times("happiness", "");
    // Means of 406 clips of CASME II and SAMM, weighted by clips: (32 x 194 + 26 x 190) / 58 ms up, (32 x 170 + 26 x 178) / 58 down
    EXPECT_EQ(times("happiness", R"(, "manner": "micro")"), (std::array{0.192, 0.0, 0.174}));
    // An expression that neither study has takes the mean of all: (249 x 167 + 157 x 165) / 406, (249 x 167 + 157 x 202) / 406
    EXPECT_EQ(times("pride", R"(, "manner": "micro")"), (std::array{0.166, 0.0, 0.181}));
    const auto posed = times("happiness", R"(, "manner": "posed")"),
               spontaneous = times("happiness", R"(, "manner": "spontaneous")");
    for (const int i : {0, 2}) {
        EXPECT_LT(posed[i], usual[i]);
        EXPECT_GT(spontaneous[i], usual[i]);
    }
    EXPECT_EQ(posed[1], usual[1]);
    // What the event gives itself wins.
    EXPECT_EQ(times("happiness", R"(, "manner": "micro", "hold_s": 0.1)"),
              (std::array{0.192, 0.1, 0.174}));
    EXPECT_EQ(message_of([&] { times("happiness", R"(, "manner": "shy")"); }),
              "script.json:/events/0/manner: expected one of \"posed\" \"spontaneous\" \"micro\", "
              "found \"shy\"");
}

TEST(Expressions, HaveMannersWithEitherAFactorOrTimes) {
    const auto read = [](const std::string& text) {
        return read_manner(JsonCursor::from_json(Json::parse(text), "manners.json"), "shy");
    };
    EXPECT_EQ(
        message_of([&] {
            read(
                R"({"source": "x", "factor": {"onset": 1, "hold": 1, "offset": 1}, "onset_s": 1})");
        }),
        "manners.json:/: expected either a factor or times, found both");
    EXPECT_EQ(message_of([&] { read(R"({"source": "x"})"); }),
              "manners.json:/: expected the key \"onset_s\", found none");
    const Manner slow = read(R"({"source": "x", "factor": {"onset": 20, "hold": 2, "offset": 0}})");
    EXPECT_EQ(slow.times("joy", {10, 1, 1}).onset_s, 60) << "the limit of a script";
    EXPECT_EQ(slow.times("joy", {10, 1, 1}).hold_s, 2);
}

TEST(Expressions, ComeWithOneSmoothRiseOfSpeed) {
    for (const char* name : kSeven) {
        const double onset = tables().expressions.find(name)->onset_s;
        const Timeline timeline = of(name, "");
        const UnitIntensity seen(script_with(name, ""), tables().facs);
        double before = 0, speed_before = 0, excited_before = 0;
        int peaks = 0;
        for (double t = 0.5; t <= 0.5 + onset; t += onset / 100) {
            const std::vector<double> units = seen.at(t);
            const double sum = std::accumulate(units.begin(), units.end(), 0.0);
            const double speed = sum - before;
            const double excited = timeline.at(t).excitation.cwiseAbs().sum();
            EXPECT_GE(excited, excited_before - 1e-9) << name << " at " << t;
            excited_before = excited;
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
    const auto smile = [](const std::string& more) {
        const UnitIntensity seen(script_with("happiness", more), tables().facs);
        const std::vector<std::string>& names = seen.names();
        const auto at = [&](const char* unit) {
            return seen.at(1.3)[std::find(names.begin(), names.end(), unit) - names.begin()];
        };
        return std::pair{at("AU12.l"), at("AU12.r")};
    };
    const auto [even_left, even_right] = smile("");
    EXPECT_EQ(even_left, even_right);
    const auto [left, right] = smile(R"(, "asymmetry": 0.2)");
    const double weaker = std::min(left, right), stronger = std::max(left, right);
    EXPECT_EQ(stronger, even_left);
    EXPECT_LE(weaker, 0.9 * stronger + 1e-12);
    EXPECT_GE(weaker, 0.8 * stronger - 1e-12);
}

TEST(Expressions, AndTheirVariantsSayWhoPublishedThem) {
    int variants = 0;
    for (const Expression& e : tables().expressions.list) {
        EXPECT_EQ(e.source.empty(), e.name == "neutral") << e.name;
        for (const ExpressionVariant& variant : e.variants) {
            EXPECT_FALSE(variant.source.empty()) << e.name << " " << variant.name;
            EXPECT_FALSE(variant.parts.units.empty()) << e.name << " " << variant.name;
            ++variants;
        }
    }
    EXPECT_GE(variants, 60);
    // The 21 categories of Du, Tao and Martinez 2014, table 1
    for (const char* name : {"happiness",
                             "sadness",
                             "fear",
                             "anger",
                             "surprise",
                             "disgust",
                             "happily_surprised",
                             "happily_disgusted",
                             "sadly_fearful",
                             "sadly_angry",
                             "sadly_surprised",
                             "sadly_disgusted",
                             "fearfully_angry",
                             "fearfully_surprised",
                             "fearfully_disgusted",
                             "angrily_surprised",
                             "angrily_disgusted",
                             "disgustedly_surprised",
                             "appalled",
                             "hatred",
                             "awe"})
        EXPECT_NE(tables().expressions.find(name), nullptr) << name;
}

TEST(Expressions, HaveTheUnitsOfTheVariant) {
    // At least 70 % of 230 people showed these units in anger: 4, 7, 24; more than half also 17.
    const Drive observed = of("anger", R"(, "variant": "observed")").at(1.4);
    const int mentalis = tables().column("mentalis.l"), procerus = tables().column("procerus.l");
    EXPECT_GT(observed.excitation[mentalis], 0.5);
    EXPECT_LT(observed.excitation[procerus], of("anger", "").at(1.4).excitation[procerus]);
    // The core pattern of five cultures has only 4 and 7.
    EXPECT_EQ(of("anger", R"(, "variant": "core")").at(1.4).excitation[mentalis], 0);
    EXPECT_EQ(
        message_of([] { of("anger_open", R"(, "variant": "core")"); }),
        "script.json:/events/0/variant: expected a variant of \"anger_open\", which has none, "
        "found \"core\"");
    EXPECT_EQ(message_of([] { of("interest", R"(, "variant": "core")"); }),
              "script.json:/events/0/variant: expected a variant of \"interest\", one of "
              "\"prototype_2019\", found \"core\"");
}

TEST(Expressions, AddTheirMusclesToTheUnits) {
    const int column = tables().column("corrugator_supercilii.r");
    const Expression& anger = *tables().expressions.find("anger");
    ASSERT_FALSE(anger.parts.muscles.empty());
    // The unit asks for 0.98, the expression for 1 more. What a muscle gets ends at 1.
    EXPECT_EQ(of("anger", "").at(1.4).excitation[column], 1);
    const double unit =
        tables().facs.find("AU4")->curve.muscles.activation(0.25) *
        expand(*tables().facs.find("AU4"), std::nullopt, tables().channels).excitation[column];
    EXPECT_NEAR(of("anger", R"(, "intensity": 0.25)").at(1.4).excitation[column],
                unit + curve_of_added_muscles().muscles.activation(0.25), 1e-12);
    EXPECT_EQ(of("anger", R"(, "side": "l")").at(1.4).excitation[column], 0);
    const Drive uneven = of("anger", R"(, "asymmetry": 0.3, "intensity": 0.5)").at(1.4);
    EXPECT_NE(uneven.excitation[column],
              uneven.excitation[tables().column("corrugator_supercilii.l")]);
}

}  // namespace
}  // namespace risorius::track
