// SPDX-License-Identifier: MIT
// Intensity of the action units that a script asks for, in every way it can ask.
#include "risorius/track/unit_intensity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "track/standard_tables.h"

namespace risorius::track {
namespace {

double intensity_in(const Json& script_parts, const std::string& unit, double t_s) {
    Json script{
        {"format", "risorius-script"}, {"version", 1}, {"rig", "rig.json"}, {"duration_s", 3}};
    script.update(script_parts);
    const ScriptDescription read =
        read_script(JsonCursor::from_json(script, "script"), tables().channels, tables().facs,
                    tables().expressions);
    const UnitIntensity intensity(read, tables().facs);
    const auto& names = intensity.names();
    const auto at = std::find(names.begin(), names.end(), unit);
    if (at == names.end()) throw std::runtime_error("no unit " + unit);
    return intensity.at(t_s)[static_cast<std::size_t>(at - names.begin())];
}

TEST(UnitIntensity, FollowsChannelsOnTheirSide) {
    const Json script{{"channels",
                       {{"AU12", {{"keys", {{0, 0.4}}}}},
                        {"AU12.l", {{"keys", {{0, 0.3}}}}},
                        {"AU25", {{"keys", {{0, 0.2}}}}},
                        {"AU30.l", {{"keys", {{0, 0.6}}}}}}}};
    EXPECT_NEAR(intensity_in(script, "AU12.l", 1), 0.7, 1e-12);
    EXPECT_NEAR(intensity_in(script, "AU12.r", 1), 0.4, 1e-12);
    EXPECT_NEAR(intensity_in(script, "AU25", 1), 0.2, 1e-12);
    EXPECT_NEAR(intensity_in(script, "AU30.l", 1), 0.6, 1e-12);
    EXPECT_EQ(intensity_in(script, "AU30.r", 1), 0);
}

TEST(UnitIntensity, OfAnExpressionIsItsShareAtTheMoment) {
    const Json script{{"events",
                       {{{"expression", "happiness"},
                         {"intensity", 0.5},
                         {"start_s", 1},
                         {"onset_s", 0.4},
                         {"hold_s", 1},
                         {"offset_s", 0.4}}}}};
    EXPECT_EQ(intensity_in(script, "AU12.l", 0.9), 0);
    const double held = intensity_in(script, "AU12.l", 1.6);
    EXPECT_GT(held, 0.2);
    EXPECT_LE(held, 0.5);
    EXPECT_LT(intensity_in(script, "AU12.l", 1.2), held);
    EXPECT_EQ(intensity_in(script, "AU12.l", 2.9), 0);
}

TEST(UnitIntensity, OfABlinkLastsWhileItIsDriven) {
    const Json script{{"events", {{{"blink", {{"side", "r"}}}, {"start_s", 1}}}}};
    EXPECT_EQ(intensity_in(script, "AU45.r", 0.99), 0);
    EXPECT_EQ(intensity_in(script, "AU45.r", 1.05), 1);
    EXPECT_EQ(intensity_in(script, "AU45.l", 1.05), 0);
    EXPECT_EQ(intensity_in(script, "AU45.r", 1.09), 0);
}

TEST(UnitIntensity, SumsEndAtOne) {
    const Json script{
        {"channels", {{"AU6", {{"keys", {{0, 0.8}}}}}, {"AU6.r", {{"keys", {{0, 0.9}}}}}}}};
    EXPECT_EQ(intensity_in(script, "AU6.r", 0), 1);
}

}  // namespace
}  // namespace risorius::track
