// SPDX-License-Identifier: MIT
// Activations of OpenSim: names of every kind become the channels of muscles, with the numbers of the file.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "paths.h"
#include "risorius/core/json_cursor.h"
#include "risorius/motion/import_motion.h"
#include "temporary_folder.h"

namespace risorius::motion {
namespace {

const std::string kHeader = "controls\nversion=1\nnRows=3\nnColumns=6\ninDegrees=no\nendheader\n";

class StorageTest : public testing::Test {
  protected:
    RecordedMotion read(const std::string& text, const std::string& as = "") const {
        std::ofstream(folder_ / "a.sto", std::ios::binary) << text;
        return read_motion(folder_ / "a.sto", {.as = as});
    }
    std::string complaint(const std::string& text) const {
        std::string said = message_of([&] { read(text, "storage"); });
        const std::string here = folder_.path().string() + "/";
        if (const std::size_t at = said.find(here); at != std::string::npos)
            said.erase(at, here.size());
        return said;
    }
    TemporaryFolder folder_;
};

TEST_F(StorageTest, NamesOfEveryKindAreChannels) {
    const RecordedMotion motion = read(
        kHeader +
        "time\tzygomaticus_major_l\t/forceset/masseter_deep_r/activation\t"
        "procerus.activation\tfrontalis_2_l\t/forceset/masseter_deep_r/fiber_length\n"
        "0.5\t0\t0.25\t0.1\t0\t0.03\n0.75 0.5 0.25 0.2 0 0.03\n1\t1e0\t0.5\t.3\t0.125\t0.03\n");
    EXPECT_EQ(motion.format, "storage");
    EXPECT_EQ(motion.times_s, (std::vector<double>{0, 0.25, 0.5}));
    EXPECT_EQ(motion.fps, 4);
    const std::pair<const char*, std::vector<double>> expected[] = {
        {"zygomaticus_major.l", {0, 0.5, 1}},
        {"masseter_deep.r", {0.25, 0.25, 0.5}},
        {"procerus", {0.1, 0.2, 0.3}},
        {"frontalis.l", {0, 0, 0.125}}};
    ASSERT_EQ(motion.tracks.size(), 4u);
    for (const auto& [channel, values] : expected) {
        const RecordedTrack* track = motion.find(channel);
        ASSERT_NE(track, nullptr) << channel;
        EXPECT_EQ(track->values, values) << channel;
    }
    EXPECT_EQ(motion.unmapped,
              (std::vector<std::string>{"/forceset/masseter_deep_r/fiber_length"}));
}

TEST_F(StorageTest, BecomesAScriptOfActivations) {
    std::ofstream(folder_ / "a.mot") << kHeader
                                     << "time zygomaticus_major_l zygomaticus_major_r knee_angle_r "
                                        "procerus risorius_1_l\n0 0 0.2 9 0 0\n1 0.5 0.4 9 0 0\n";
    const ImportReport report = import_motion(
        {.file = folder_ / "a.mot",
         .out = folder_ / "script.json",
         .rig = std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs" / "adult" / "rig.json"});
    EXPECT_EQ(report.unmapped, (std::vector<std::string>{"knee_angle.r"}));
    const Json script = JsonCursor::read_file(folder_ / "script.json").json();
    const Json& left = script["channels"]["zygomaticus_major.l"];
    EXPECT_TRUE(left["activation"].get<bool>());
    EXPECT_EQ(left["keys"], Json::parse("[[0.0, 0.0], [1.0, 0.5]]"));
    EXPECT_EQ(script["channels"]["zygomaticus_major.r"]["keys"],
              Json::parse("[[0.0, 0.2], [1.0, 0.4]]"));
    EXPECT_EQ(script["channels"].size(), 2u);
}

TEST_F(StorageTest, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(complaint("controls\ntime a\n"), "a.sto: expected a line endheader, found none");
    EXPECT_EQ(complaint("endheader\na b\n"),
              "a.sto: line 2: expected time as the first column, found \"a\"");
    EXPECT_EQ(complaint("endheader\ntime a_l\n0 1\n1\n"),
              "a.sto: line 4: expected 2 numbers, as the columns, found 1");
    EXPECT_EQ(complaint("endheader\ntime a_l\n0 x\n"),
              "a.sto: line 3, column a_l: expected a number, found \"x\"");
    EXPECT_EQ(complaint("endheader\ntime a_l\n1 0\n0 0\n"),
              "a.sto: sample 2: expected times that rise, found -1 s after 0 s");
    EXPECT_EQ(complaint("endheader\ntime a_l\n"), "a.sto: expected samples of motion, found none");
}

}  // namespace
}  // namespace risorius::motion
