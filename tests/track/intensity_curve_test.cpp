// SPDX-License-Identifier: MIT
// What a coder would call a quarter, a half and three quarters of a unit is what the script asks for.
#include "risorius/track/intensity_curve.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"
#include "track/standard_tables.h"

namespace risorius::track {
namespace {

TEST(IntensityCurve, IsTheIdentityWithoutPoints) {
    for (double x : {-0.3, 0.0, 0.1, 0.25, 0.6, 1.0, 1.4})
        EXPECT_NEAR(IntensityCurve().activation(x), x, 1e-15);
}

TEST(IntensityCurve, RunsThroughItsPointsAndOnlyRises) {
    const IntensityCurve curve({0.02, 0.3, 0.35});
    EXPECT_EQ(curve.activation(0), 0);
    EXPECT_NEAR(curve.activation(0.25), 0.02, 1e-15);
    EXPECT_NEAR(curve.activation(0.5), 0.3, 1e-15);
    EXPECT_NEAR(curve.activation(0.75), 0.35, 1e-15);
    EXPECT_EQ(curve.activation(1), 1);
    for (double x = 0; x < 1; x += 0.005)
        EXPECT_GT(curve.activation(x + 0.005), curve.activation(x)) << x;
    EXPECT_EQ(curve.activation(-0.4), -curve.activation(0.4));
}

TEST(IntensityCurve, MusclesAndJawOfAUnitHaveCurvesOfTheirOwn) {
    Json json = Json::parse(
        R"({"format": "risorius-script", "version": 1, "rig": "rig.json", "duration_s": 4})");
    json["channels"] = Json::parse(R"({"AU26": {"keys": [[0, 0.5]]}})");
    FacsTable facs = tables().facs;
    const auto drive_with = [&](const UnitCurves& curves) {
        for (ActionUnit& unit : facs.units)
            if (unit.id == "AU26") unit.curve = curves;
        const ScriptDescription script = read_script(JsonCursor::from_json(json, "script.json"),
                                                     tables().channels, facs, tables().expressions);
        return Timeline(script, tables().channels).at(1);
    };
    const Expansion full = expand(*facs.find("AU26"), std::nullopt, tables().channels);
    const int digastric = tables().column("digastric_anterior.l");
    const double open = full.kinematic[static_cast<std::size_t>(Kinematic::kJawOpen)];
    ASSERT_GT(full.excitation[digastric], 0);
    ASSERT_GT(open, 0);
    const IntensityCurve low({0.1, 0.2, 0.4});
    Drive drive = drive_with({low, {}});
    EXPECT_NEAR(drive.excitation[digastric], 0.2 * full.excitation[digastric], 1e-12);
    EXPECT_NEAR(drive.at(Kinematic::kJawOpen), 0.5 * open, 1e-12);
    drive = drive_with({{}, low});
    EXPECT_NEAR(drive.excitation[digastric], 0.5 * full.excitation[digastric], 1e-12);
    EXPECT_NEAR(drive.at(Kinematic::kJawOpen), 0.2 * open, 1e-12);
    // Activation that is set directly leaves the jaw its curve.
    json["channels"]["AU26"]["activation"] = true;
    drive = drive_with({{}, low});
    EXPECT_NEAR(drive.activation[digastric], 0.5 * full.excitation[digastric], 1e-12);
    EXPECT_NEAR(drive.at(Kinematic::kJawOpen), 0.2 * open, 1e-12);
}

TEST(IntensityCurve, InATableMustRise) {
    const auto read = [](const std::string& points, const std::string& key = "activation_at") {
        read_facs(
            JsonCursor::from_json(Json::parse(R"({"ranges": {"jaw_forward_mm": 9, "jaw_side_mm": 8,
                      "tongue_out_mm": 45}, "action_units": {"AU1": {"name": "Inner brow raiser",
                      "sided": true, ")" + key +
                                              "\": " + points + "}}}"),
                                  "facs.json"),
            tables().channels);
    };
    EXPECT_EQ(message_of([&] { read("[0.2, 0.4]"); }),
              "facs.json:/action_units/AU1/activation_at: expected three activations, found 2");
    EXPECT_EQ(message_of([&] { read("[0.2, 0.2, 0.5]"); }),
              "facs.json:/action_units/AU1/activation_at/1: expected more than 0.2, found 0.2");
    EXPECT_EQ(message_of([&] { read("[0.2, 0.4, 1]", "channels_at"); }),
              "facs.json:/action_units/AU1/channels_at/2: expected [0.001, 0.999], found 1");
}

}  // namespace
}  // namespace risorius::track
