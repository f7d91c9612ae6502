// SPDX-License-Identifier: MIT
// A set of random facial movements: its table alone makes the clips again.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/stimuli/batch.h"
#include "temporary_folder.h"

namespace risorius::stimuli {
namespace {

namespace fs = std::filesystem;

std::string bytes_in(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SampleSet, IsMadeAgainFromItsTableAlone) {
    const TemporaryFolder folder;
    Json design = Json::parse(R"({"format": "risorius-design", "version": 1, "name": "random",
        "clips": {"quality": "draft", "ending": "mkv"},
        "sets": [{"name": "random", "clip": "${trial}", "controls": ["neutral"],
            "script": {"format": "risorius-script", "version": 1, "fps": 5,
                       "view": {"width_px": 48, "height_px": 48, "antialiasing": 1}},
            "sample": {"units": "face41", "trials": 2}}]})");
    design["sets"][0]["script"]["rig"] = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";
    const auto make = [&](const char* out) {
        std::ofstream(folder.path() / "design.json") << design.dump();
        const BatchReport report = make_batch(
            {.design = folder.path() / "design.json", .out = folder.path() / out, .workers = 2});
        EXPECT_EQ(report.made, 3) << "two trials and a neutral face";
    };
    make("drawn");
    const fs::path drawn = folder.path() / "drawn";
    const animate::FrameRows table = animate::frame_rows(bytes_in(drawn / "sample.tsv"));
    ASSERT_GE(table.rows(), 2);
    EXPECT_EQ(table.cells[0][1], "stim-1");
    const Json columns = Json::parse(bytes_in(drawn / "sample.json"));
    for (const std::string& name : table.names) EXPECT_TRUE(columns.contains(name)) << name;
    // What moves at all is what the table says
    const animate::FrameRows frames =
        animate::frame_rows(bytes_in(drawn / "stimuli/stim-1_annot-frames_events.tsv"));
    EXPECT_EQ(frames.rows(), 6);
    fs::copy_file(drawn / "sample.tsv", folder.path() / "sample.tsv");
    design["sets"][0]["sample"] = {{"table", "sample.tsv"}};
    design["seed"] = 99;
    make("read");
    for (const char* clip : {"1", "2"}) {
        const std::string name = "stimuli/stim-" + std::string(clip) + "_video.mkv";
        EXPECT_EQ(bytes_in(drawn / name), bytes_in(folder.path() / "read" / name)) << clip;
    }
    EXPECT_EQ(bytes_in(drawn / "sample.tsv"), bytes_in(folder.path() / "read/sample.tsv"));
    EXPECT_NE(bytes_in(drawn / "stimuli/stim-1_video.mkv"),
              bytes_in(drawn / "stimuli/stim-2_video.mkv"));
}

}  // namespace
}  // namespace risorius::stimuli
