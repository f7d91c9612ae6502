// SPDX-License-Identifier: MIT
// The table of wrinkle lines is read as written, and mistakes in it are found.
#include "risorius/rig/wrinkle_table.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "message_of.h"
#include "rig/heads.h"

namespace risorius::rig {
namespace {

Json table_with(const Json& pattern) {
    return {{"format", "risorius-wrinkles"}, {"version", 1}, {"patterns", Json::array({pattern})}};
}

Json small_pattern() {
    return {
        {"name", "across"},
        {"slot", 1},
        {"wavelength_mm", 5},
        {"fraction", 0.5},
        {"fibres", Json::array({Json{{"muscle", "procerus"}, {"right", -1}}})},
        {"window",
         Json::array({Json{
             {"of", "height"},
             {"falls",
              Json::array({Json{{"landmark", "n"}, {"axis", "y"}, {"plus_mm", {1, 2.5}}}, 7})}}})}};
}

std::vector<WrinklePattern> read_lines(const Json& pattern) {
    return read_wrinkles(JsonCursor::from_json(table_with(pattern), "lines"), {"n", "g"});
}

TEST(WrinkleTable, IsReadAsWritten) {
    const std::vector<WrinklePattern> patterns = read_lines(small_pattern());
    ASSERT_EQ(patterns.size(), 1u);
    const WrinklePattern& one = patterns[0];
    EXPECT_EQ(one.slot, 1);
    EXPECT_EQ(one.wavelength_mm, 5);
    EXPECT_EQ(one.jitter, 0.16);  // the default
    ASSERT_EQ(one.fibres.size(), 1u);
    EXPECT_EQ(one.fibres[0].left, 1);
    EXPECT_EQ(one.fibres[0].right, -1);
    ASSERT_EQ(one.window.size(), 1u);
    EXPECT_TRUE(one.window[0].falls);
    EXPECT_EQ(one.window[0].from.landmark, "n");
    EXPECT_EQ(one.window[0].from.plus_mm, (std::vector<double>{1, 2.5}));
    EXPECT_EQ(one.window[0].to.plus_mm, std::vector<double>{7});
}

TEST(WrinkleTable, RefusesUnknownKeysAndLandmarks) {
    Json pattern = small_pattern();
    pattern["colour"] = 1;
    EXPECT_NE(risorius::message_of([&] { read_lines(pattern); }).find("lines:/patterns/0"),
              std::string::npos);
    pattern = small_pattern();
    pattern["anchor"] = "sto";
    EXPECT_EQ(risorius::message_of([&] { read_lines(pattern); }),
              "lines:/patterns/0/anchor: expected a landmark of the atlas, found \"sto\"");
    pattern = small_pattern();
    pattern["slot"] = 3;
    EXPECT_NE(risorius::message_of([&] { read_lines(pattern); }).find("lines:/patterns/0/slot"),
              std::string::npos);
}

TEST(WrinkleTable, ARigWithoutOneHasTheLinesOfTheStandardAnatomy) {
    EXPECT_EQ(adult().rig.atlas.wrinkles.size(), 13u);
    bool recorded = false;
    for (const auto& file : adult().rig.table_files)
        recorded = recorded || file.filename() == kWrinkleFile;
    EXPECT_TRUE(recorded);
}

}  // namespace
}  // namespace risorius::rig
