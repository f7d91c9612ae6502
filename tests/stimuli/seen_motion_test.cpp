// SPDX-License-Identifier: MIT
// What is seen to move in a clip, and what the tables say about it.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "paths.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/core/read_file.h"
#include "risorius/media/video_reader.h"
#include "risorius/stimuli/batch.h"
#include "temporary_folder.h"

namespace risorius::stimuli {
namespace {

namespace fs = std::filesystem;

constexpr double kFps = 30;

std::string content_of(const fs::path& file) {
    return read_file(file, {"a text file", 64 * kMegabyte});
}

Json script_of(const char* rest) {
    Json script = Json::parse(R"({"format": "risorius-script", "version": 1, "fps": 30,
        "view": {"width_px": 48, "height_px": 64, "antialiasing": 1}})");
    script["rig"] = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";
    script.update(Json::parse(rest));
    return script;
}

/// Two sets: "plain" with controls, and "idle", whose expression begins at 0.7 s after a blink.
Json design_of() {
    Json design = Json::parse(R"({"format": "risorius-design", "version": 1, "name": "Seen",
        "clips": {"quality": "preview", "crf": 14}, "sets": [
            {"name": "plain", "clip": "plain${intensity}", "factors": {"intensity": [0.5, 1]},
             "controls": [{"control": "reversed", "when": {"intensity": 1}},
                          {"control": "scrambled", "when": {"intensity": 1}},
                          {"control": "apex", "when": {"intensity": 1}}]},
            {"name": "idle", "clip": "idle"}]})");
    design["sets"][0]["script"] = script_of(R"({"duration_s": 0.8, "events": [{
        "expression": "happiness", "intensity": "${intensity}", "start_s": 0.1, "onset_s": 0.2,
        "hold_s": 0.4, "offset_s": 0.2}]})");
    design["sets"][1]["script"] = script_of(R"({"duration_s": 1.1, "events": [
        {"idle": {"blinks_per_minute": 0, "sway": 3}, "start_s": 0, "end_s": 1.1},
        {"blink": {}, "start_s": 0.1},
        {"expression": "happiness", "start_s": 0.7, "onset_s": 0.2, "hold_s": 0.3, "offset_s": 0.2}]})");
    return design;
}

/// Column -> cell, of the rows of a table by its first column.
std::map<std::string, std::map<std::string, std::string>> rows_of(const fs::path& file) {
    const animate::FrameRows rows = animate::frame_rows(content_of(file));
    std::map<std::string, std::map<std::string, std::string>> out;
    for (const std::vector<std::string>& cells : rows.cells)
        for (std::size_t c = 0; c < cells.size(); ++c) out[cells[0]][rows.names[c]] = cells[c];
    return out;
}

class SeenMotionOfClips : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = new TemporaryFolder;
        out = new fs::path(make(design_of(), "set"));
        clips = new auto(rows_of(*out / "stimuli/stimuli.tsv"));
    }
    static void TearDownTestSuite() {
        delete clips;
        delete out;
        delete folder;
    }
    static fs::path make(const Json& design, const char* name) {
        const fs::path file = folder->path() / (std::string(name) + ".json");
        std::ofstream(file) << design.dump();
        EXPECT_TRUE(
            make_batch({.design = file, .out = folder->path() / name, .workers = 2}).complete);
        return folder->path() / name;
    }
    static double value(const char* clip, const char* column) {
        return std::stod(clips->at(clip).at(column));
    }
    static inline TemporaryFolder* folder = nullptr;
    static inline fs::path* out = nullptr;
    static inline std::map<std::string, std::map<std::string, std::string>>* clips = nullptr;
};

/// The first shown frame in which a landmark of the face is farther than 0.3 mm from where it is in the first one. The head stands
/// still.
int first_moved(const fs::path& table) {
    const animate::FrameRows rows = animate::frame_rows(content_of(table));
    for (int r = 0; r < rows.rows(); ++r)
        for (std::size_t c = 0; c < rows.names.size(); ++c) {
            const std::string& name = rows.names[c];
            if (!name.ends_with(".x_mm") || name == "cer.x_mm" || name == "hyo.x_mm") continue;
            double squared = 0;
            for (int k = 0; k < 3; ++k) {
                const int column = static_cast<int>(c) + k;
                squared += std::pow(rows.number(r, column) - rows.number(0, column), 2);
            }
            if (squared > 0.3 * 0.3) return r;
        }
    return -1;
}

TEST_F(SeenMotionOfClips, BeginsWithTheFirstShownFrameThatMoves) {
    for (const char* clip : {"plain1", "plain1Reversed", "plain1Scrambled", "plain0p5"})
        EXPECT_EQ(
            std::lround(kFps * value(("stim-" + std::string(clip)).c_str(), "seen_onset_s")),
            first_moved(*out / ("stimuli/stim-" + std::string(clip) + "_annot-frames_events.tsv")))
            << clip;
    EXPECT_LT(value("stim-plain1Reversed", "seen_onset_s"), 0.2) << "its end is the start";
    EXPECT_EQ(clips->at("stim-plain1Scrambled").at("seen_offset_s"), "n/a");
    EXPECT_EQ(value("stim-plain1", "commanded_onset_s"), 0.1);
    EXPECT_EQ(value("stim-plain1", "commanded_apex_s"), 0.3);
    EXPECT_NEAR(value("stim-plain1", "pixel_onset_s"), value("stim-plain1", "seen_onset_s"), 0.07);
}

TEST_F(SeenMotionOfClips, IsAShareOfWhatFullIntensityShows) {
    EXPECT_NEAR(value("stim-plain1", "seen_share"), 1, 0.02) << "it is held for 0.4 s";
    EXPECT_EQ(value("stim-plain0p5", "full_mm"), value("stim-plain1", "full_mm"));
    EXPECT_NEAR(value("stim-plain0p5", "seen_share"),
                value("stim-plain0p5", "seen_mm") / value("stim-plain1", "full_mm"), 1e-5);
    EXPECT_GT(value("stim-plain0p5", "seen_share"), 0.6) << "more than is commanded";
}

TEST_F(SeenMotionOfClips, LeavesOutHeadBlinksAndIdling) {
    EXPECT_GE(value("stim-idle", "seen_onset_s"), 0.7);
    EXPECT_LE(value("stim-idle", "seen_onset_s"), 0.8);
    EXPECT_NEAR(value("stim-idle", "blink_onset_s"), 0.15, 0.06);
    EXPECT_LT(value("stim-idle", "head_onset_s"), 0.6);
    EXPECT_EQ(clips->at("stim-plain1").at("blink_onset_s"), "n/a") << "a smile narrows the lids";
    EXPECT_EQ(clips->at("stim-plain1").at("head_onset_s"), "n/a");
}

TEST_F(SeenMotionOfClips, IsNoneInAStillWhoseFramesDecodeAlike) {
    for (const char* column : {"seen_mm", "seen_share", "seen_onset_s", "seen_apex_s",
                               "velocity_peak_mm_s", "pixel_onset_s", "head_onset_s"})
        EXPECT_EQ(clips->at("stim-plain1Apex").at(column), "n/a") << column;
    const std::string triggers = content_of(*out / "triggers.tsv");
    EXPECT_NE(triggers.find("plain1Apex\tclip_off\t4\t24\t"), std::string::npos);
    EXPECT_EQ(triggers.find("plain1Apex\tapex"), std::string::npos);
    EXPECT_EQ(triggers.find("plain1Apex\tmovement_onset"), std::string::npos);
    media::VideoReader video(*out / "stimuli/stim-plain1Apex_video.mp4");
    ASSERT_EQ(video.frames(), 24);
    const Image first = video.frame(0);
    for (int n = 1; n < 24; ++n) EXPECT_EQ(video.frame(n).rgba, first.rgba) << n;
}

TEST_F(SeenMotionOfClips, IsTheSameWithoutLandmarksInTheTables) {
    Json design = design_of();
    design["clips"]["landmarks"] = false;
    design["sets"].erase(1);
    const fs::path without = make(design, "without");
    std::istringstream all(content_of(*out / "triggers.tsv"));
    std::string expected;
    for (std::string line; std::getline(all, line);)
        if (!line.starts_with("idle\t")) expected += line + "\n";
    EXPECT_EQ(content_of(without / "triggers.tsv"), expected);
    const std::string table = content_of(without / "stimuli/stim-plain1_annot-frames_events.tsv");
    EXPECT_EQ(table.substr(0, table.find('\n')).find(".x_mm"), std::string::npos);
    // Every column is described
    const Json columns =
        Json::parse(content_of(without / "stimuli/stim-plain1_annot-frames_events.json"));
    for (const std::string& name : animate::frame_rows(table).names)
        EXPECT_TRUE(columns.at(name).contains("Description")) << name;
}

}  // namespace
}  // namespace risorius::stimuli
