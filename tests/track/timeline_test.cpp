// SPDX-License-Identifier: MIT
#include "risorius/track/timeline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "track/standard_tables.h"

namespace risorius::track {
namespace {

ScriptDescription script_of(const std::string& channels, const std::string& events = "[]") {
    Json json = Json::parse(
        R"({"format": "risorius-script", "version": 1, "rig": "rig.json", "duration_s": 4})");
    json["channels"] = Json::parse(channels);
    json["events"] = Json::parse(events);
    return read_script(JsonCursor::from_json(json, "script.json"), tables().channels, tables().facs,
                       tables().expressions);
}

Timeline timeline(const std::string& channels, const std::string& events = "[]") {
    return Timeline(script_of(channels, events), tables().channels);
}

double excitation(const Drive& drive, const std::string& column) {
    return drive.excitation[tables().column(column)];
}

double activity(const Drive& drive) {
    double sum = drive.excitation.cwiseAbs().sum();
    for (double k : drive.kinematic) sum += std::abs(k);
    return sum;
}

TEST(Timeline, OfAnEmptyScriptIsRest) {
    const Drive drive = timeline("{}").at(1.0);
    EXPECT_EQ(activity(drive), 0.0);
    EXPECT_EQ(drive.excitation.size(), 84);
    for (double a : drive.activation) EXPECT_TRUE(std::isnan(a));
}

/// What a unit of this intensity asks of a muscle.
double asked(const std::string& unit, const std::string& column, double intensity) {
    const ActionUnit& found = *tables().facs.find(unit);
    return found.curve.muscles.activation(intensity) *
           expand(found, std::nullopt, tables().channels).excitation[tables().column(column)];
}

/// Asks for half of zygomaticus, and leaves a third of expressions.
class OtherSource : public DriveSource {
  public:
    void add(double t_s, Expansion& sum) const override {
        if (t_s < 1) sum.excitation[tables().column("zygomaticus_major.l")] += 0.5;
    }
    void weaken_expressions(double t_s, Eigen::VectorXd& factor) const override {
        if (t_s < 1) factor *= 1.0 / 3;
    }
};

TEST(Timeline, OtherSourcesAreAddedAndWeakenExpressions) {
    ScriptDescription script =
        script_of(R"({"zygomaticus_major": {"keys": [[0, 0.1]]}})",
                  R"([{"expression": "happiness", "intensity": 0.4, "start_s": 0, "onset_s": 0,
                       "hold_s": 4}])");
    const Drive without = Timeline(script, tables().channels).at(0.5);
    script.sources.push_back(std::make_shared<OtherSource>());
    const Timeline face(script, tables().channels);
    const double smile = excitation(without, "zygomaticus_major.r") - 0.1;
    EXPECT_NEAR(excitation(face.at(0.5), "zygomaticus_major.r"), 0.1 + smile / 3, 1e-12);
    EXPECT_NEAR(excitation(face.at(0.5), "zygomaticus_major.l"),
                std::min(1.0, 0.1 + smile / 3 + 0.5), 1e-12);
    EXPECT_EQ(excitation(face.at(1.5), "zygomaticus_major.l"),
              excitation(Timeline(script_of(R"({"zygomaticus_major": {"keys": [[0, 0.1]]}})",
                                            R"([{"expression": "happiness", "intensity": 0.4,
                                                 "start_s": 0, "onset_s": 0, "hold_s": 4}])"),
                                  tables().channels)
                             .at(1.5),
                         "zygomaticus_major.l"));
}

TEST(Timeline, SourcesAddUpAndAreClamped) {
    const Timeline face = timeline(R"({
        "zygomaticus_major":   {"keys": [[0, 0.3]]},
        "zygomaticus_major.l": {"keys": [[0, 0.6]]},
        "AU12":                {"keys": [[0, 0.6]]}})");
    const Drive drive = face.at(0.5);
    EXPECT_EQ(excitation(drive, "zygomaticus_major.l"), 1.0);
    EXPECT_NEAR(excitation(drive, "zygomaticus_major.r"),
                0.3 + asked("AU12", "zygomaticus_major.r", 0.6), 1e-15);
    EXPECT_NEAR(excitation(drive, "zygomaticus_minor.r"), asked("AU12", "zygomaticus_minor.r", 0.6),
                1e-15);
}

TEST(Timeline, LevatorMayGoToMinusOneAndKinematicsStayInTheirRange) {
    const Timeline face = timeline(R"({
        "levator_palpebrae_superioris": {"keys": [[0, -0.8]]}, "AU43": {"keys": [[0, 1]]},
        "jaw_open": {"keys": [[0, 0.7]]}, "AU27": {"keys": [[0, 1]]},
        "jaw_side": {"keys": [[0, -0.6]]}, "AU30.r": {"keys": [[0, 1]]},
        "head_yaw_deg": {"keys": [[0, 60]]}, "AU51": {"keys": [[0, 1]]}})");
    const Drive drive = face.at(0);
    EXPECT_EQ(excitation(drive, "levator_palpebrae_superioris.r"), -1.0);
    EXPECT_EQ(drive.at(Kinematic::kJawOpen), 1.2);
    EXPECT_EQ(drive.at(Kinematic::kJawSide), -1.0);
    EXPECT_EQ(drive.at(Kinematic::kHeadYaw), 75.0);
}

TEST(Timeline, GazeChannelsDriveOneEyeOrBoth) {
    const Drive drive = timeline(R"({"gaze_yaw_deg": {"keys": [[0, 10]]},
        "gaze_yaw_deg.l": {"keys": [[0, 2]]}, "gaze_pitch_deg.r": {"keys": [[0, -5]]}})")
                            .at(0);
    EXPECT_EQ(drive.at(Kinematic::kGazeYawLeft), 12.0);
    EXPECT_EQ(drive.at(Kinematic::kGazeYawRight), 10.0);
    EXPECT_EQ(drive.at(Kinematic::kGazePitchLeft), 0.0);
    EXPECT_EQ(drive.at(Kinematic::kGazePitchRight), -5.0);
}

TEST(Timeline, DirectActivationOfAUnitIsThatOfItsMusclesAndPlacesTheJaw) {
    const Drive drive = timeline(R"({"AU12": {"keys": [[0, 0.5]], "activation": true},
        "AU26": {"keys": [[0, 0.5]], "activation": true},
        "zygomaticus_major.l": {"keys": [[0, 0.1]], "activation": true}})")
                            .at(1);
    const auto column = [](const char* name) { return tables().column(name); };
    EXPECT_NEAR(drive.activation[column("zygomaticus_minor.r")],
                asked("AU12", "zygomaticus_minor.r", 0.5), 1e-15);
    EXPECT_NEAR(drive.activation[column("zygomaticus_major.l")],
                0.1 + asked("AU12", "zygomaticus_major.l", 0.5), 1e-15);
    EXPECT_EQ(excitation(drive, "zygomaticus_major.l"), 0);
    const ActionUnit& drop = *tables().facs.find("AU26");
    ASSERT_GT(drop.kinematic[static_cast<std::size_t>(Kinematic::kJawOpen)], 0);
    EXPECT_NEAR(drive.at(Kinematic::kJawOpen),
                0.5 * drop.kinematic[static_cast<std::size_t>(Kinematic::kJawOpen)], 1e-15);
}

TEST(Timeline, ShapesOfArkitAreChannelsThatTheTableExpands) {
    const Drive drive = timeline(R"({"mouthSmileLeft": {"keys": [[0, 0.5]]},
        "eyeLookOutLeft": {"keys": [[0, 0.4]], "activation": true},
        "jawOpen": {"keys": [[0, 0.25]], "activation": true}})")
                            .at(1);
    EXPECT_NEAR(excitation(drive, "zygomaticus_minor.l"), asked("AU12", "zygomaticus_minor.l", 0.5),
                1e-15);
    EXPECT_EQ(excitation(drive, "zygomaticus_minor.r"), 0);
    EXPECT_GT(drive.at(Kinematic::kGazeYawLeft), 5);
    EXPECT_EQ(drive.at(Kinematic::kGazeYawRight), 0);
    const ArkitShape& open = *tables().facs.find_arkit("jawOpen");
    ASSERT_TRUE(open.jaw.open);
    EXPECT_NEAR(drive.at(Kinematic::kJawOpen), 0.25 * *open.jaw.open, 1e-15);
    EXPECT_GT(drive.activation[tables().column("platysma.l")], 0);
}

TEST(Timeline, DirectActivationIsSetOnlyWhereTheScriptSetsIt) {
    const Timeline face = timeline(R"({"mentalis.l": {"keys": [[0, 0.7]], "activation": true},
        "mentalis": {"keys": [[0, 0.2]]}})");
    const Drive drive = face.at(1);
    EXPECT_EQ(drive.activation[tables().column("mentalis.l")], 0.7);
    EXPECT_TRUE(std::isnan(drive.activation[tables().column("mentalis.r")]));
    EXPECT_EQ(excitation(drive, "mentalis.l"), 0.2);
    int set = 0;
    for (double a : drive.activation) set += std::isnan(a) ? 0 : 1;
    EXPECT_EQ(set, 1);
}

const char* kSmile = R"([{"expression": "happiness", "intensity": 0.5, "start_s": 1.0,
                          "onset_s": 0.4, "hold_s": 0.6, "offset_s": 0.8}])";

TEST(Timeline, ExpressionIsZeroOutsideAndItsIntensityAtTheApex) {
    const Timeline face = timeline("{}", kSmile);
    EXPECT_EQ(activity(face.at(1.0)), 0.0);
    EXPECT_EQ(activity(face.at(2.8)), 0.0);
    // In the table, AU12 has the value 1, AU6 0.8, and zygomaticus major gets 0.5 more.
    const auto zygomaticus = [](double intensity) {
        return asked("AU12", "zygomaticus_major.l", intensity) +
               0.5 * curve_of_added_muscles().muscles.activation(intensity);
    };
    for (double t : {1.4, 1.7, 1.99}) {
        EXPECT_NEAR(excitation(face.at(t), "zygomaticus_major.l"), zygomaticus(0.5), 1e-15);
        EXPECT_NEAR(excitation(face.at(t), "orbicularis_oculi_orbital.r"),
                    asked("AU6", "orbicularis_oculi_orbital.r", 0.5 * 0.8), 1e-15);
    }
    // Half way through the onset, and through the slower offset.
    EXPECT_NEAR(excitation(face.at(1.2), "zygomaticus_major.l"), zygomaticus(0.25), 1e-12);
    EXPECT_NEAR(excitation(face.at(2.4), "zygomaticus_major.l"), zygomaticus(0.25), 1e-12);
}

TEST(Timeline, CheekRaiserTrailsTheLipCornersInASmile) {
    const Timeline face = timeline("{}", kSmile);
    const Drive early = face.at(1.05);  // the delay of AU6 is 15 % of 0.4 s
    EXPECT_GT(excitation(early, "zygomaticus_major.l"), 0.0);
    EXPECT_EQ(excitation(early, "orbicularis_oculi_orbital.l"), 0.0);
    EXPECT_GT(excitation(face.at(1.1), "orbicularis_oculi_orbital.l"), 0.0);
}

TEST(Timeline, ExpressionHasNoJumps) {
    const Timeline face = timeline("{}", kSmile);
    const double h = 1e-3;
    Drive previous = face.at(0.9);
    for (double t = 0.9 + h; t < 3; t += h) {
        const Drive now = face.at(t);
        // The peak speed of a minimum-jerk rise of 0.4 in 0.34 s is 2.2 per second; the curves of intensity are at most twice as steep.
        ASSERT_LT((now.excitation - previous.excitation).cwiseAbs().maxCoeff(), 4.6 * h) << t;
        previous = now;
    }
}

TEST(Timeline, ExpressionWithoutOnsetOrOffsetSwitches) {
    const Timeline face = timeline("{}", R"([{"expression": "disgust", "start_s": 1, "onset_s": 0,
                                              "hold_s": 0.5, "offset_s": 0}])");
    EXPECT_EQ(activity(face.at(0.999)), 0.0);
    EXPECT_GT(activity(face.at(1.0)), 0.0);
    EXPECT_EQ(activity(face.at(1.5)), 0.0);
}

TEST(Timeline, OneSidedExpressionLeavesTheOtherSideAtRest) {
    const Drive drive =
        timeline("{}", R"([{"expression": "happiness", "start_s": 0, "onset_s": 0, "side": "r"}])")
            .at(0.1);
    EXPECT_EQ(excitation(drive, "zygomaticus_major.l"), 0.0);
    EXPECT_GT(excitation(drive, "zygomaticus_major.r"), 0.4);
}

TEST(Timeline, BlinkSilencesTheLevatorThenFiresOrbicularisAndEndsBoth) {
    const Timeline face = timeline("{}", R"([{"blink": {}, "start_s": 1.0}])");
    const char* levator = "levator_palpebrae_superioris.l";
    const char* orbicularis = "orbicularis_oculi_palpebral_upper.l";
    EXPECT_EQ(activity(face.at(0.999)), 0.0);
    EXPECT_EQ(excitation(face.at(1.005), levator), -1.0);
    EXPECT_EQ(excitation(face.at(1.005), orbicularis), 0.0);
    EXPECT_EQ(excitation(face.at(1.011), orbicularis), 0.5);
    EXPECT_EQ(excitation(face.at(1.079), levator), -1.0);
    EXPECT_EQ(excitation(face.at(1.079), orbicularis), 0.5);
    EXPECT_EQ(activity(face.at(1.0801)), 0.0);
}

TEST(Timeline, BlinkHasASideAnIntensityAndADuration) {
    const Timeline face = timeline("{}", R"([
        {"blink": {"side": "r", "intensity": 0.5, "duration_s": 0.5}, "start_s": 1.0}])");
    const Drive drive = face.at(1.3);
    EXPECT_EQ(excitation(drive, "orbicularis_oculi_palpebral_upper.l"), 0.0);
    EXPECT_EQ(excitation(drive, "orbicularis_oculi_palpebral_upper.r"), 0.25);
    EXPECT_EQ(excitation(drive, "levator_palpebrae_superioris.r"), -0.5);
    EXPECT_EQ(activity(face.at(1.361)), 0.0);
}

TEST(Timeline, WeakMusclesGetWhatIsLeft) {
    const auto face = [](const std::string& weakness) {
        Json json = Json::parse(
            R"({"format": "risorius-script", "version": 1, "rig": "rig.json", "duration_s": 4,
                "channels": {"AU12": {"keys": [[0, 0.8]]}, "jaw_open": {"keys": [[0, 0.5]]},
                             "risorius.r": {"keys": [[0, 0.5]], "activation": true}}})");
        json["weakness"] = Json::parse(weakness);
        return Timeline(read_script(JsonCursor::from_json(json, "script.json"), tables().channels,
                                    tables().facs, tables().expressions),
                        tables().channels)
            .at(1);
    };
    const Drive whole = face("{}"), left = face(R"({"left": 1})"),
                one = face(R"({"zygomaticus_major.r": 0.25, "right": 0.1})"),
                both = face(R"({"risorius": 0.5})");
    const double full = excitation(whole, "zygomaticus_major.l");
    EXPECT_GT(full, 0.1);
    EXPECT_EQ(excitation(left, "zygomaticus_major.l"), 0);
    EXPECT_EQ(excitation(left, "zygomaticus_major.r"), full);
    EXPECT_EQ(left.at(Kinematic::kJawOpen), 0.5);
    EXPECT_EQ(excitation(one, "zygomaticus_major.l"), full);
    EXPECT_NEAR(excitation(one, "zygomaticus_major.r"), 0.75 * full, 1e-15);
    EXPECT_NEAR(excitation(one, "zygomaticus_minor.r"),
                0.9 * excitation(whole, "zygomaticus_minor.r"), 1e-15);
    EXPECT_EQ(both.activation[tables().column("risorius.r")], 0.25);
    EXPECT_TRUE(std::isnan(both.activation[tables().column("risorius.l")]));
}

TEST(Timeline, ASideMayHearOfEverythingLater) {
    Json json = Json::parse(
        R"({"format": "risorius-script", "version": 1, "rig": "rig.json", "duration_s": 4,
            "channels": {"AU12": {"keys": [[1, 0], [2, 1]]}}})");
    const auto face = [&] {
        return Timeline(read_script(JsonCursor::from_json(json, "script.json"), tables().channels,
                                    tables().facs, tables().expressions),
                        tables().channels);
    };
    const Timeline together = face();
    json["late_s"] = {{"right", 0.25}};
    const Timeline apart = face();
    for (const double t_s : {0.9, 1.1, 1.5, 2.1, 3.0}) {
        EXPECT_EQ(excitation(apart.at(t_s), "zygomaticus_major.l"),
                  excitation(together.at(t_s), "zygomaticus_major.l"));
        EXPECT_EQ(excitation(apart.at(t_s), "zygomaticus_major.r"),
                  excitation(together.at(t_s - 0.25), "zygomaticus_major.r"));
    }
}

TEST(Timeline, GivesTheSameBitsEveryTimeAndInAnyOrder) {
    const Timeline a = timeline(R"({"AU12": {"keys": [[0, 0], [0.4, 0.8], [3, 0]]}})", kSmile);
    const Timeline b = timeline(R"({"AU12": {"keys": [[0, 0], [0.4, 0.8], [3, 0]]}})", kSmile);
    a.at(2.9);
    for (double t : {0.3, 1.3, 2.2}) EXPECT_EQ(a.at(t).excitation, b.at(t).excitation);
}

TEST(Timeline, HelloStartsAndEndsAtRestAndShowsItsPartsApart) {
    const ScriptDescription hello =
        read_script(std::filesystem::path(RISORIUS_SOURCE_DIR) / "samples/hello/script.json",
                    tables().channels, tables().facs, tables().expressions);
    const Timeline face(hello, tables().channels);
    for (double t : {0.0, 0.2, 3.8, 4.0}) EXPECT_EQ(activity(face.at(t)), 0.0) << t;
    EXPECT_GT(excitation(face.at(0.7), "zygomaticus_major.l"), 0.4);
    EXPECT_EQ(excitation(face.at(1.5), "zygomaticus_major.l"), 0.0);
    EXPECT_GT(excitation(face.at(1.5), "frontalis_medial.r"), 0.4);
    EXPECT_EQ(excitation(face.at(1.8), "orbicularis_oculi_palpebral_upper.r"), 0.5);
    EXPECT_NEAR(face.at(2.3).at(Kinematic::kJawOpen), 0.50, 1e-12);
    EXPECT_GT(excitation(face.at(2.95), "corrugator_supercilii.l"), 0.6);
    EXPECT_GT(excitation(face.at(3.45), "zygomaticus_major.l"), 0.25);
    EXPECT_EQ(excitation(face.at(3.45), "zygomaticus_major.r"), 0.0);
}

}  // namespace
}  // namespace risorius::track
