// SPDX-License-Identifier: MIT
// What a rig was calibrated on is told by the rig itself, as a list or as the file of one.
#include "risorius/rig/calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "paths.h"
#include "risorius/core/error.h"
#include "temporary_folder.h"

namespace risorius::rig {
namespace {

const std::filesystem::path kStandard =
    std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/standard" / kCalibrationFile;

TEST(Calibration, OfTheStandardAnatomyNamesEveryExpressionOnce) {
    const auto names = read_calibration(JsonCursor::read_file(kStandard));
    EXPECT_EQ(names.size(), 16u);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

TEST(Calibration, IsReadFromAListAndFromAFile) {
    const TemporaryFolder folder;
    const auto of = [&](const Json& value) {
        std::ofstream(folder / "rig.json") << Json{{"calibrated_on", value}}.dump();
        return calibrated_on(folder / "rig.json");
    };
    EXPECT_EQ(of({"a", "b"}), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(of(kStandard.string()), read_calibration(JsonCursor::read_file(kStandard)));
    std::ofstream(folder / "rig.json") << "{}";
    EXPECT_TRUE(calibrated_on(folder / "rig.json").empty());
}

TEST(Calibration, OfAnotherFormatIsRefused) {
    try {
        read_calibration(JsonCursor::from_json(
            {{"format", "risorius-rig"}, {"version", 1}, {"source", ""}, {"expressions", {"a"}}},
            "x.json"));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(
            std::string(error.what()),
            "x.json:/format: expected one of \"risorius-calibration\", found \"risorius-rig\"");
    }
}

}  // namespace
}  // namespace risorius::rig
