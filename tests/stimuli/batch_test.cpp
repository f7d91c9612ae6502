// SPDX-License-Identifier: MIT
// Clips of a design: the same bytes however they come about, kept while nothing changes.
#include "risorius/stimuli/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/media/tone.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/wav_file.h"
#include "stimuli/batch_fixture.h"
#include "tools/risorius/check_files.h"

namespace risorius::stimuli {
namespace {

namespace fs = std::filesystem;

TEST_F(Batch, MakesTheSameBytesHoweverItGoes) {
    const fs::path file = design("design.json", {0.5, 1},
                                 R"(["reversed", "upside_down", "phase_scrambled", "flipped"])");
    std::map<std::string, std::string> told;
    BatchOptions options{.design = file,
                         .out = folder().path() / "one",
                         .workers = 1,
                         .report_clip = [&](const std::string& clip, const std::string& state,
                                            const std::string&) { told[clip] = state; }};
    const BatchReport first = make_batch(options);
    EXPECT_EQ(first.made, 10);
    EXPECT_TRUE(first.complete);
    EXPECT_EQ(told.at("smile0p5Reversed"), "made");
    const std::string sums = text_of(options.out / "SHA256SUMS");
    const fs::path video = options.out / "stimuli/stim-smile1_video.mkv";
    const std::string smile = text_of(video);

    // In two parts, on two threads each
    BatchOptions parts = options;
    parts.out = folder().path() / "two";
    parts.workers = 2;
    parts.parts = 2;
    parts.part = 2;
    const BatchReport half = make_batch(parts);
    EXPECT_EQ(half.made, 5);
    EXPECT_EQ(half.elsewhere, 5);
    EXPECT_FALSE(half.complete);
    EXPECT_FALSE(fs::exists(parts.out / "SHA256SUMS"));
    parts.parts = parts.part = parts.workers = 1;
    EXPECT_EQ(make_batch(parts).made, 5);
    EXPECT_EQ(text_of(parts.out / "SHA256SUMS"), sums);

    // Kept while it is whole, also for another design: what is common stays, what it does not have goes
    EXPECT_EQ(make_batch(options).kept, 10);
    std::ofstream(video, std::ios::app) << "x";
    options.design = design("design.json", {1, 0.8, 0.5});
    fs::remove(options.out / "stimuli/stim-smile0p5_video.json");
    // Files that may be somebody's are replaced on request only
    EXPECT_NE(message_of([&] { make_batch(options); }).find("as `batch` has written it"),
              std::string::npos);
    options.replace = true;
    const BatchReport other = make_batch(options);
    options.replace = false;
    EXPECT_EQ(other.made, 3);
    EXPECT_EQ(text_of(video), smile);
    EXPECT_FALSE(fs::exists(options.out / "stimuli/stim-smile1Reversed_video.mkv"));
    options.design = design("design.json", {1, 0.8});
    // Whoever keeps something beside it keeps it
    const fs::path others[] = {options.out / "stimuli/ratings.tsv",
                               options.out / "overview/talk.png"};
    for (const fs::path& other_file : others) std::ofstream(other_file) << "mine";
    const BatchReport less = make_batch(options);
    EXPECT_EQ(less.made, 0);
    for (const fs::path& other_file : others) EXPECT_EQ(text_of(other_file), "mine");
    EXPECT_FALSE(fs::exists(options.out / "overview/smile0p5.png"));
    EXPECT_FALSE(fs::exists(options.out / "code/scripts/smile0p5.json"));
    EXPECT_EQ(less.kept, 2);
    EXPECT_FALSE(fs::exists(options.out / "stimuli/stim-smile0p5_video.mkv"));
    EXPECT_TRUE(fs::exists(options.out / "stimuli/stim-smile0p8_video.mkv"));

    // Controls show the same in another order and upside down
    const auto frames = [](const fs::path& of) {
        media::VideoReader reader(of);
        std::vector<Image> out;
        for (int i = 0; i < reader.frames(); ++i) out.push_back(reader.frame(i));
        return out;
    };
    const std::vector<Image> plain = frames(video),
                             back = frames(parts.out / "stimuli/stim-smile1Reversed_video.mkv"),
                             turned = frames(parts.out / "stimuli/stim-smile1UpsideDown_video.mkv");
    ASSERT_EQ(plain.size(), 5u);
    ASSERT_EQ(back.size(), 5u);
    // Above the photodiode's square
    const auto same = [](const Image& a, const Image& b) {
        return std::equal(a.rgba.begin(), a.rgba.begin() + 4 * 48 * 56, b.rgba.begin());
    };
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_TRUE(same(plain[i], back[4 - i])) << i;
        for (const int y : {10, 30, 50})
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(plain[i].pixel(20, y)[k], turned[i].pixel(27, 63 - y)[k]);
    }
    EXPECT_FALSE(same(plain[0], plain[4]));
    const animate::FrameRows rows = animate::frame_rows(
        text_of(parts.out / "stimuli/stim-smile1Reversed_annot-frames_events.tsv"));
    ASSERT_EQ(rows.rows(), 5);
    EXPECT_EQ(rows.number(0, rows.column("source_frame")), 4);
    // Corners of the mouth that go up by so much go down
    const auto corner = [&](const char* clip, int frame) {
        const animate::FrameRows of = animate::frame_rows(text_of(
            parts.out / "stimuli" / ("stim-" + std::string(clip) + "_annot-frames_events.tsv")));
        return of.number(frame, of.column("ch_l.y_mm"));
    };
    const double up = corner("smile1", 4) - corner("smile1", 0);
    EXPECT_GT(up, 2);
    EXPECT_NEAR(corner("smile1Flipped", 4) - corner("smile1Flipped", 0), -up, 1e-3);
    EXPECT_EQ(rows.number(1, rows.column("onset")), 0.1);
}

TEST_F(Batch, MatchesLuminanceOverTheSetAlsoInParts) {
    Json json = Json::parse(text_of(design("match.json", {0.2, 1}, R"(["reversed"])")));
    json["match"] = {{"luminance", {{"within", "face"}, {"mean", 0.2}, {"sd", 0.08}}}};
    json["clips"].erase("landmarks");
    std::ofstream(folder().path() / "match.json") << json.dump();
    BatchOptions options{
        .design = folder().path() / "match.json", .out = folder().path() / "matched", .workers = 1};
    EXPECT_EQ(make_batch(options).made, 4);
    const Json report = Json::parse(text_of(options.out / "luminance/luminance.json"));
    EXPECT_GT(std::abs(report["before"]["mean"].get<double>() - 0.2), 0.03);
    // What rounding to bytes leaves
    EXPECT_NEAR(report["after"]["mean"].get<double>(), 0.2, 2e-3);
    EXPECT_NEAR(report["after"]["sd"].get<double>(), 0.08, 2e-3);
    EXPECT_EQ(report["greatest_cut_off"], 0);
    EXPECT_TRUE(fs::exists(options.out / "luminance/mean.svg"));
    EXPECT_FALSE(fs::exists(options.out / "intermediate"));

    // The table tells of the pictures as they are shown; the photodiode stays black and white
    media::VideoReader video(options.out / "stimuli/stim-smile1_video.mkv");
    const animate::FrameRows rows =
        animate::frame_rows(text_of(options.out / "stimuli/stim-smile1_annot-frames_events.tsv"));
    Image second = video.frame(1);
    EXPECT_EQ(second.pixel(1, 62)[0], 0);
    EXPECT_EQ(video.frame(0).pixel(1, 62)[0], 255);
    media::LuminanceSums sums;
    for (int y = 0; y < 8; ++y)  // the square is 6 pixels wide
        for (int x = 0; x < 8; ++x) std::fill_n(second.pixel(x, 56 + y), 3, second.pixel(40, 5)[0]);
    sums.add(second);
    EXPECT_NEAR(rows.number(1, rows.column("luminance_mean")), sums.mean(), 2e-3);

    // In parts nothing is made before all is measured; the bytes are the same
    BatchOptions parts = options;
    parts.out = folder().path() / "matched in parts";
    parts.parts = parts.part = 2;
    const BatchReport half = make_batch(parts);
    EXPECT_EQ(half.made, 0);
    EXPECT_EQ(half.unmeasured, 1) << "of two conditions";
    EXPECT_FALSE(half.complete);
    EXPECT_TRUE(fs::exists(parts.out / "intermediate"));
    // Earlier versions kept unmatched renders in the folder "takes"; a set that they have begun is continued
    fs::rename(parts.out / "intermediate", parts.out / "takes");
    parts.parts = parts.part = 1;
    int rendered = 0;
    parts.report_clip = [&](const std::string&, const std::string& state, const std::string&) {
        rendered += state == "filmed";
    };
    EXPECT_TRUE(make_batch(parts).complete);
    EXPECT_EQ(rendered, 1);
    EXPECT_FALSE(fs::exists(parts.out / "takes"));
    EXPECT_FALSE(fs::exists(parts.out / "intermediate"));
    EXPECT_EQ(text_of(parts.out / "SHA256SUMS"), text_of(options.out / "SHA256SUMS"));
    EXPECT_EQ(make_batch(parts).kept, 4);
}

TEST_F(Batch, RefusesBeforeAnythingIsMade) {
    const auto complaint = [](const fs::path& file, const fs::path& out) {
        return message_of([&] { make_batch({.design = file, .out = out, .workers = 1}); });
    };
    const fs::path out = folder().path() / "never";
    Json json = Json::parse(text_of(design("bad.json", {0.5, 1})));
    const auto with = [&](const char* place, const Json& value) {
        Json bad = json;
        bad[Json::json_pointer(place)] = value;
        std::ofstream(folder().path() / "bad.json") << bad.dump();
        return complaint(folder().path() / "bad.json", out);
    };
    const std::string folder_of = folder().path().string();
    EXPECT_EQ(
        with("/sets/0/script/events/0/expression", "hapiness").substr(0, folder_of.size() + 26),
        folder_of + "/bad.json, clip smile0p5:/");
    EXPECT_NE(with("/sets/0/script/events/0/expression", "hapiness").find("\"happiness\""),
              std::string::npos);
    EXPECT_NE(with("/sets/0/script/duration_s", "= 0 - 1").find("expected (0, 3600]"),
              std::string::npos);
    EXPECT_NE(with("/clips/photodiode", "middle").find("clips/photodiode: expected"),
              std::string::npos);
    Json turning = Json::parse(R"({"head_yaw_deg": {"keys": [[0, 0], [0.4, 10]]}})");
    json["sets"][0]["controls"] = {"flipped"};
    EXPECT_NE(with("/sets/0/script/channels", turning).find("a head that does not move"),
              std::string::npos);
    json["sets"][0]["controls"] = Json::array();
    EXPECT_NE(with("/sets/0/script/fps", 0).find("/fps: expected"), std::string::npos);
    EXPECT_FALSE(fs::exists(out));
    // A folder of somebody else
    fs::create_directory(folder().path() / "mine");
    std::ofstream(folder().path() / "mine/notes.txt") << "do not touch";
    EXPECT_NE(complaint(design("good.json", {0.5}), folder().path() / "mine")
                  .find("expected an empty folder, or one that `batch` has begun"),
              std::string::npos);
}

// A ladder of asynchronies: the same gain, nothing cut off, equal lengths, and sound minus movement as asked.
TEST_F(Batch, BeginsBeforeALeadingSound) {
    constexpr int kRate_hz = 8000;
    media::Sound beep;
    beep.rate_hz = kRate_hz;
    for (int i = 0; i < kRate_hz / 2; ++i)
        beep.samples.push_back(0.2f * static_cast<float>(std::cos(0.3 * i)));
    media::write_wav(beep, folder().path() / "beep.wav");
    Json json = Json::parse(text_of(design("early.json", {1})));
    json["clips"].erase("photodiode");
    json["match"]["loudness"]["lufs"] = -30;
    json["clips"]["quality"] = "draft";
    Json& set = json["sets"][0];
    set["audio"] = "beep.wav";
    set["audio_start_s"] = "= 0.05 + soa_ms / 1000";
    set["factors"]["soa_ms"] = {-230, 0, 80};
    set["clip"] = "soa_${soa_ms}";
    set["script"]["duration_s"] = 0.7;
    std::ofstream(folder().path() / "early.json") << json.dump();
    const BatchOptions options{
        .design = folder().path() / "early.json", .out = folder().path() / "early", .workers = 2};
    EXPECT_EQ(make_batch(options).made, 3);
    std::map<int, Json> sidecars;
    for (const auto& [soa_ms, clip] :
         std::map<int, std::string>{{-230, "soaM230"}, {0, "soa0"}, {80, "soa80"}}) {
        const fs::path stem = options.out / ("stimuli/stim-" + clip);
        const Json sidecar = Json::parse(text_of(stem.string() + "_audiovideo.json"));
        // 0.18 s before the script: two frames of 0.1 s
        EXPECT_EQ(sidecar.at("frames"), 9);
        const int onset = sidecar.at("movement_onset_frame");
        EXPECT_GE(onset, 3);
        EXPECT_NEAR(sidecar.at("motion").at("commanded_onset_s").get<double>(), 0.25, 1e-9);
        media::VideoReader video(stem.string() + "_audiovideo.mkv");
        ASSERT_EQ(video.frames(), 9);
        EXPECT_EQ(video.frame(0).rgba, video.frame(2).rgba);
        EXPECT_NE(video.frame(2).rgba, video.frame(onset + 1).rgba);
        const media::Sound heard = media::read_sound(stem.string() + "_audio.wav");
        const auto sounds = [](float sample) { return sample != 0; };
        const auto first = std::find_if(heard.samples.begin(), heard.samples.end(), sounds);
        const double sound_s = static_cast<double>(first - heard.samples.begin()) / kRate_hz;
        EXPECT_NEAR(sound_s - 0.25, soa_ms / 1000.0, 1e-3) << clip;
        EXPECT_NEAR(sidecar.at("audio").at("onset_s").get<double>(), sound_s, 1e-3) << clip;
        EXPECT_NEAR(std::count_if(heard.samples.begin(), heard.samples.end(), sounds), kRate_hz / 2,
                    5);
        EXPECT_NEAR(sidecar.at("audio").at("gain_db").get<double>(),
                    sidecars.empty()
                        ? sidecar.at("audio").at("gain_db").get<double>()
                        : sidecars.begin()->second.at("audio").at("gain_db").get<double>(),
                    1e-9);
        sidecars[soa_ms] = sidecar;
    }
}

// No folder of a large set has more than a thousand files; a set that fits into one is flat.
TEST_F(Batch, HasItsClipsInFoldersWhenItIsLarge) {
    std::vector<double> intensities;
    for (std::size_t i = 0; i < kClipsPerFolder; ++i)
        intensities.push_back(static_cast<double>(i + 1) / 1000);
    const BatchPlan flat = plan_batch(design("flat.json", intensities));
    ASSERT_EQ(flat.clips.size(), kClipsPerFolder);
    for (const ClipPlan& clip : flat.clips) EXPECT_EQ(clip.folder, "");
    intensities.push_back(1);
    const BatchPlan large = plan_batch(design("large.json", intensities));
    ASSERT_EQ(large.clips.size(), kClipsPerFolder + 1);
    EXPECT_EQ(large.clips[kClipsPerFolder - 1].folder, "b000/");
    EXPECT_EQ(large.clips[kClipsPerFolder].folder, "b001/");
    std::map<fs::path, std::size_t> entries;
    for (const ClipPlan& clip : large.clips) {
        const ClipFiles files = clip_files(clip);
        ++entries[files.sidecar.parent_path()];
        for (const fs::path& file : files.listed()) ++entries[file.parent_path()];
    }
    EXPECT_EQ(entries.size(), 6u) << "stimuli, overview and code/scripts, two folders each";
    for (const auto& [below, count] : entries) EXPECT_LE(count, 1000u) << below;
    EXPECT_EQ(file_in_stimuli(large.clips.back()), "b001/stim-smile1_video.mkv");
    // The folder is no reason to make a clip anew.
    EXPECT_EQ(large.clips.front().content_sha256, flat.clips.front().content_sha256);
}

TEST_F(Batch, NotesWhatMayNotBeMeant) {
    const fs::path file = design("notes.json", {0.5, 1});
    EXPECT_TRUE(plan_batch(file).notes.empty());
    Json json = Json::parse(text_of(file));
    json["sets"][0]["factors"]["fps"] = {25, 50};
    json["sets"][0]["clip"] = "smile_${intensity}_${fps}";
    json["experiment"] = {{"programs", {"psychopy"}},
                          {"question", "How much?"},
                          {"answers", {{"h", "0.5"}}},
                          {"correct", "intensity"}};
    json["clips"]["ending"] = "mp4";
    std::ofstream(file) << json.dump();
    const std::vector<std::string> notes = cli::check_file(file).notes;
    ASSERT_EQ(notes.size(), 2u) << cli::check_file(file).error;
    EXPECT_EQ(
        notes[0],
        "experiment: none of the answers is correct for 2 of the clips shown, smile125 the first");
    EXPECT_EQ(notes[1],
              "2 clips show the same as others (smile0p550 is smile0p525 again): does the "
              "script use every factor?");
    std::ofstream(folder().path() / "late.json")
        << Json{{"format", "risorius-script"},
                {"version", 1},
                {"rig", kAdult},
                {"duration_s", 1},
                {"channels", {{"AU12", {{"keys", {{0, 0}, {3, 1}}}}}}}};
    const cli::CheckResult late = cli::check_file(folder().path() / "late.json");
    ASSERT_EQ(late.notes.size(), 1u) << late.error;
    EXPECT_EQ(late.notes[0], "\"AU12\" has a key at 3 s, after the end at 1 s");
}

}  // namespace
}  // namespace risorius::stimuli
