// SPDX-License-Identifier: MIT
// Recordings and sounds as users bring them, in the whole program. Meshes are in mesh_table_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "paths.h"
#include "risorius/core/json_text.h"
#include "risorius/media/detail/sound.h"
#include "shell.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

namespace fs = std::filesystem;
const fs::path kCases = fs::path(RISORIUS_SOURCE_DIR) / "tests/inputs/public_cases";

class PublicCases : public testing::Test {
  protected:
    ShellResult run_here(const std::string& arguments) const {
        return run_shell("cd '" + folder_.path().string() + "' && '" +
                         (fs::path(RISORIUS_BINARY_DIR) / "risorius").string() + "' " + arguments +
                         " 2>&1");
    }
    /// A script of the folder with the adult, and with other keys in "emg".
    std::string script(const std::string& name, const Json& more = Json::object()) const {
        std::ifstream in(kCases / (name + ".json"));
        Json json = Json::parse(in);
        json["rig"] = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";
        for (const auto& [key, value] : more.items()) json["emg"][key] = value;
        json["emg"]["file"] = (kCases / (name + ".tsv")).string();
        std::ofstream(folder_ / "script.json") << json_text(json);
        return "script.json";
    }
    TemporaryFolder folder_;
};

TEST_F(PublicCases, ClocksOfRecordersAreNamedAndMayBeginAtTheFirstRow) {
    for (const std::string command : {"check ", "render --still 0 --draft -o x.png "}) {
        const auto [code, said] = run_here(command + script("emg_clock_of_recorder"));
        EXPECT_EQ(code, 2) << said;
        EXPECT_NE(said.find("found " + (kCases / "emg_clock_of_recorder.tsv").string() +
                            " from 173902.123 s"),
                  std::string::npos)
            << said;
    }
    const auto [code, said] =
        run_here("check " + script("emg_clock_of_recorder", {{"time_origin", "first_row"}}));
    EXPECT_EQ(code, 0) << said;
}

TEST_F(PublicCases, PlusSignsAreNumbersAndShortGapsAreBridged) {
    EXPECT_EQ(run_here("check " + script("emg_plus_signs")).code, 0);
    const auto [code, said] = run_here("check " + script("emg_gap_na"));
    EXPECT_EQ(code, 0) << said;
    EXPECT_NE(said.find("missing"), std::string::npos) << said;
}

TEST_F(PublicCases, SoundsComeThroughAtTheirLevel) {
    script("emg_plus_signs");
    for (const std::string name : {"wav_24_bits_in_32", "wav_written_into_pipe"}) {
        const auto [code, said] =
            run_here("render script.json --draft --size 16x16 --fps 5 --audio '" +
                     (kCases / (name + ".wav")).string() + "' -o " + name + ".mkv");
        ASSERT_EQ(code, 0) << name << "\n" << said;
        double peak = 0;
        for (const float sample : media::read_sound(folder_ / (name + ".mkv")).samples)
            peak = std::max(peak, static_cast<double>(std::abs(sample)));
        EXPECT_NEAR(20 * std::log10(peak), -20, 0.1) << name;
    }
}

}  // namespace
}  // namespace risorius
