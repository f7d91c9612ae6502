// SPDX-License-Identifier: MIT
// What a laboratory gets of one run: every frame findable, everything in it known, the sound in its place.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "message_of.h"
#include "risorius/animate/animate.h"
#include "risorius/animate/compare.h"
#include "risorius/animate/sheet.h"
#include "risorius/core/error.h"
#include "risorius/media/float_image.h"
#include "risorius/media/image_file.h"
#include "risorius/media/luminance.h"
#include "risorius/media/sync_marks.h"
#include "risorius/media/video_reader.h"
#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 120, kStimulusFrames = 5;

/// Where the pictures of a sheet begin: sixteen grey pixels in line, which no letter has.
int top_of_pictures(const Image& sheet) {
    const auto grey = [&](int y) {
        for (int x = 24; x < 40; ++x)
            if (sheet.pixel(x, y)[1] != 128) return false;
        return true;
    };
    int top = 0;
    while (top < sheet.height_px && !grey(top)) ++top;
    return top;
}

fs::path smile_of(const Folder& folder, const std::string& name, double max) {
    const Json script{
        {"format", "risorius-script"},
        {"version", 1},
        {"rig", (kRoot / "rigs/adult/rig.json").string()},
        {"fps", 25},
        {"duration_s", 0.2},
        {"channels",
         {{"AU12", {{"keys", {{0, 0.1}, {0.16, max}}}, {"interpolation", "linear"}}},
          {"AU2.l", {{"keys", {{0, 0.25}}}}},
          {"gaze_yaw_deg", {{"keys", {{0, 10}}}}},
          {"head_yaw_deg", {{"keys", {{0, -4}, {0.16, 4}}}, {"interpolation", "linear"}}}}},
        {"events", {{{"blink", Json::object()}, {"start_s", 0.05}}}},
        {"view", {{"width_px", kSide}, {"height_px", kSide}}}};
    std::ofstream(folder / name) << script.dump();
    return folder / name;
}

/// Column name -> values, a row per frame.
std::map<std::string, std::vector<double>> columns_of(const fs::path& file) {
    std::istringstream text(text_of(file));
    std::string line, cell;
    std::vector<std::string> names;
    std::getline(text, line);
    std::istringstream head(line);
    while (std::getline(head, cell, '\t')) names.push_back(cell);
    std::map<std::string, std::vector<double>> columns;
    while (std::getline(text, line)) {
        std::istringstream row(line);
        for (const std::string& name : names)
            if (std::getline(row, cell, '\t')) columns[name].push_back(std::stod(cell));
    }
    return columns;
}

/// Half a second of a rising ramp, 16 bits, 8 kHz.
fs::path ramp_wav(const Folder& folder) {
    std::string bytes(
        "RIFF\0\0\0\0WAVEfmt \x10\0\0\0\1\0\1\0\x40\x1f\0\0\x80\x3e\0\0\2\0\x10\0data", 40);
    const auto put = [&](unsigned value, int count) {
        for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 255));
    };
    put(8000, 4);
    for (unsigned i = 0; i < 4000; ++i) put(i, 2);
    std::ofstream(folder / "ramp.wav", std::ios::binary) << bytes;
    return folder / "ramp.wav";
}

std::string frame_file(const char* what, int frame, const char* ending) {
    char name[64];
    std::snprintf(name, sizeof name, "a.mkv.passes/%s_%06d.%s", what, frame, ending);
    return name;
}

/// One run for all tests of this suite.
class Stimulus : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = new Folder;
        animate::RenderRequest options;
        options.script = smile_of(*folder, "smile.json", 0.9);
        options.out = *folder / "a.mkv";
        options.quality = "preview";
        options.landmarks = true;
        options.audio = ramp_wav(*folder);
        options.audio_offset = -100;
        options.marks.photodiode = "lower_right";
        options.marks.photodiode_px = 20;
        options.marks.photodiode_shows = "events";
        options.marks.frame_counter = "upper_left";
        options.marks.frame_counter_px = 4;
        options.passes = {"segmentation", "depth", "normals", "flow", "masks"};
        animate::animate(options);
        table = new std::map<std::string, std::vector<double>>(
            columns_of(*folder / "a.mkv.frames.tsv"));
    }
    static void TearDownTestSuite() {
        delete table;
        delete folder;
    }
    static Folder* folder;
    static std::map<std::string, std::vector<double>>* table;
};
Folder* Stimulus::folder = nullptr;
std::map<std::string, std::vector<double>>* Stimulus::table = nullptr;

TEST_F(Stimulus, EveryFrameSaysItsNumberAndWhetherAnEventBegins) {
    media::VideoReader video(*folder / "a.mkv");
    ASSERT_EQ(video.frames(), kStimulusFrames);
    for (int n = 0; n < kStimulusFrames; ++n) {
        const Image frame = video.frame(n);
        EXPECT_EQ(media::read_frame_counter(media::Corner::kUpperLeft, 4, frame), n);
        const bool lit = frame.pixel(kSide - 5, kSide - 5)[1] == 255;
        EXPECT_EQ(lit, n == 2) << "the blink begins at 0.05 s, frame 2 is at 0.08 s";
        EXPECT_EQ(table->at("photodiode")[static_cast<std::size_t>(n)], lit ? 1 : 0);
    }
}

TEST_F(Stimulus, SoundBeginsAtTheSampleAskedForAndEndsWithTheVideo) {
    const media::Sound sound = media::read_sound(*folder / "a.mkv");
    ASSERT_EQ(sound.rate_hz, 8000);
    ASSERT_EQ(sound.length(), 1600);
    for (std::size_t i = 0; i < 1600; ++i)
        ASSERT_EQ(sound.samples[i], static_cast<float>(i + 100) / 32768);
}

TEST_F(Stimulus, TableTellsUnitsGazeAndLuminanceOfEveryFrame) {
    for (std::size_t n = 0; n < kStimulusFrames; ++n) {
        const double t_s = static_cast<double>(n) / 25;
        EXPECT_NEAR(table->at("AU12.l")[n], 0.1 + 0.8 * std::min(1.0, t_s / 0.16), 1e-6);
        EXPECT_EQ(table->at("AU12.l")[n], table->at("AU12.r")[n]);
        EXPECT_EQ(table->at("AU2.l")[n], 0.25);
        EXPECT_EQ(table->at("AU2.r")[n], 0);
        EXPECT_EQ(table->at("AU45.r")[n], t_s >= 0.05 && t_s < 0.13 ? 1 : 0);
        // Both eyes look where gaze and head together turn them
        EXPECT_NEAR(table->at("eye_yaw_deg.l")[n],
                    table->at("gaze_yaw_deg.l")[n] + table->at("head_yaw_deg")[n], 0.5);
        EXPECT_GT(table->at("luminance_mean")[n], 0.1);
        EXPECT_NEAR(table->at("contrast_rms")[n],
                    table->at("luminance_sd")[n] / table->at("luminance_mean")[n], 1e-4);
        EXPECT_EQ(table->at("motion_energy")[n] > 0, n > 0);
    }
}

TEST_F(Stimulus, FlowOfThePixelsIsTheWayOfTheLandmarks) {
    int seen = 0;
    double worst_px = 0;
    for (int n = 0; n + 1 < kStimulusFrames; ++n) {
        const media::FloatImage flow = media::read_exr(*folder / frame_file("flow", n, "exr"));
        for (const char* id : {"prn", "g", "pg", "ma_l", "ma_r", "bp_l", "bp_r", "ls", "n"}) {
            const auto now = static_cast<std::size_t>(n);
            const double u = table->at(std::string(id) + ".u_px")[now],
                         v = table->at(std::string(id) + ".v_px")[now];
            const auto pixel = static_cast<std::size_t>(v) * kSide + static_cast<std::size_t>(u);
            if (flow.samples[3 * pixel + 2] == 0) continue;
            ++seen;
            const double du = table->at(std::string(id) + ".u_px")[now + 1] - u,
                         dv = table->at(std::string(id) + ".v_px")[now + 1] - v;
            worst_px = std::max({worst_px, std::abs(flow.samples[3 * pixel] - du),
                                 std::abs(flow.samples[3 * pixel + 1] - dv)});
        }
    }
    EXPECT_GE(seen, 30);
    EXPECT_LT(worst_px, 0.15);  // a landmark may lie half a pixel from the middle of its pixel
}

TEST_F(Stimulus, PassesAgreeWithOneAnotherAndAreListed) {
    const Json results = Json::parse(text_of(*folder / "a.mkv.passes/results.json"));
    std::set<std::string> files;
    for (const auto& entry : fs::directory_iterator(*folder / "a.mkv.passes"))
        files.insert(entry.path().filename().string());
    EXPECT_EQ(results["files"].get<std::set<std::string>>(), files);
    EXPECT_EQ(files.size(), 7u * kStimulusFrames) << "no flow of the last frame, results.json";
    const Image parts = media::read_png(*folder / frame_file("segmentation", 0, "png")),
                eyes = media::read_png(*folder / frame_file("mask_eyes", 0, "png")),
                mouth = media::read_png(*folder / frame_file("mask_mouth", 0, "png")),
                face = media::read_png(*folder / frame_file("mask_face", 0, "png"));
    const media::FloatImage depth = media::read_exr(*folder / frame_file("depth", 0, "exr")),
                            normals = media::read_exr(*folder / frame_file("normals", 0, "exr"));
    std::map<std::string, int> count;
    for (std::size_t i = 0; i < depth.samples.size(); ++i) {
        const std::string part = results["parts"][parts.rgba[4 * i]];
        ++count[part];
        EXPECT_EQ(part == "background", std::isinf(depth.samples[i]));
        const float* normal = normals.samples.data() + 3 * i;
        EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), part == "background" ? 0 : 1,
                    1e-5);
        const bool of_eye = part.starts_with("sclera") || part.starts_with("iris") ||
                            part.starts_with("pupil") || part == "eye_corner";
        EXPECT_EQ(eyes.rgba[4 * i] == 255, of_eye);
        EXPECT_EQ(mouth.rgba[4 * i] == 255, part == "lips" || part == "teeth" || part == "gums" ||
                                                part == "tongue" || part == "mouth");
        if (of_eye || part == "lips") {
            EXPECT_EQ(face.rgba[4 * i], 255) << "inside the oval";
        }
    }
    EXPECT_GT(count["skin"], 2000);
    for (const char* part : {"lips", "sclera_l", "sclera_r", "iris_l", "iris_r"})
        EXPECT_GT(count[part], 3) << part;
    // The iris of the subject's left eye is on the right of the picture
    EXPECT_EQ(parts.pixel(0, 0)[0], 0);
}

TEST(Comparison, ShowsBothScriptsInEveryFrameUntilTheLongerEnds) {
    const Folder folder;
    animate::RenderRequest left, right;
    left.script = smile_of(folder, "weak.json", 0.2);
    right.script = smile_of(folder, "strong.json", 1);
    Json shorter = Json::parse(text_of(right.script));
    shorter["duration_s"] = 0.12;
    std::ofstream(right.script) << shorter.dump();
    left.quality = right.quality = "preview";
    left.out = folder / "both.mkv";
    left.size = animate::PictureSize{48, 48};
    const Json record = animate::compare(left, right);
    media::VideoReader video(left.out);
    EXPECT_EQ(video.frames(), 5);
    EXPECT_EQ(video.width_px(), 100);
    const auto right_half = [&](int frame) {
        const Image image = video.frame(frame);
        std::string bytes;
        for (int y = 0; y < 48; ++y)
            bytes.append(reinterpret_cast<const char*>(image.pixel(52, y)), 4 * 48);
        return bytes;
    };
    EXPECT_NE(right_half(1), right_half(2));
    EXPECT_EQ(right_half(2), right_half(4)) << "it has ended and stays";
    EXPECT_EQ(record["left"]["frames"], 5);
    EXPECT_EQ(record["right"]["frames"], 3);
    EXPECT_EQ(folder.listing(),
              (std::set<std::string>{"both.mkv", "both.mkv.json", "both.mkv.left.frames.tsv",
                                     "both.mkv.right.frames.tsv", "strong.json", "weak.json"}));
}

TEST(Comparison, SheetHasTheTimesInTheirColumnsWhateverTheirOrder) {
    const Folder folder;
    animate::SheetOptions options;
    options.scripts = {smile_of(folder, "smile.json", 0.9)};
    options.times_s = {0.16, 0, 0.16};
    options.out = folder / "sheet.png";
    options.view.quality = "preview";
    options.view.show = "wire";
    options.view.size = animate::PictureSize{64, 64};
    const Json record = animate::make_sheet(options);
    EXPECT_EQ(record["runs"].size(), 1u);
    EXPECT_EQ(record["runs"][0]["frames"], 3);
    const Image sheet = media::read_png(options.out);
    const int top = top_of_pictures(sheet);
    const auto column = [&](int c) {
        std::string bytes;
        for (int y = 0; y < 64; ++y)
            bytes.append(reinterpret_cast<const char*>(sheet.pixel(24 + 67 * c, top + y)), 4 * 64);
        return bytes;
    };
    EXPECT_TRUE(column(0) == column(2)) << "the same moment";
    EXPECT_FALSE(column(0) == column(1)) << "another moment";
}

TEST(Comparison, SheetOfCamerasHasAColumnForEachAndPicturesBesideThem) {
    const Folder folder;
    animate::SheetOptions options;
    options.scripts = {smile_of(folder, "smile.json", 0.9)};
    options.times_s = {0};
    options.cameras = {"front", "top", "mouth"};
    Image red(20, 40);
    for (int i = 0; i < 20 * 40; ++i)
        std::copy_n(std::array<std::uint8_t, 4>{200, 10, 10, 255}.data(), 4, &red.rgba[4 * i]);
    media::write_png(red, folder / "red.png");
    options.beside = {folder / "red.png"};
    options.out = folder / "sheet.png";
    options.view.quality = "preview";
    options.view.size = animate::PictureSize{64, 64};
    const Json record = animate::make_sheet(options);
    ASSERT_EQ(record["runs"].size(), 3u);
    EXPECT_EQ(record["runs"][1]["camera"], "top");
    const Image sheet = media::read_png(options.out);
    std::set<std::string> pictures;
    const int top = top_of_pictures(sheet);
    int reds = 0;
    for (int c = 0; c < 3; ++c) {
        std::string bytes;
        for (int y = 0; y < 64; ++y)
            bytes.append(reinterpret_cast<const char*>(sheet.pixel(24 + 67 * c, top + y)), 4 * 64);
        pictures.insert(bytes);
    }
    EXPECT_EQ(pictures.size(), 3u);
    for (int y = 0; y < sheet.height_px; ++y)
        for (int x = 0; x < sheet.width_px; ++x)
            reds += sheet.pixel(x, y)[0] == 200 && sheet.pixel(x, y)[1] == 10;
    EXPECT_EQ(reds, 20 * 40);
    // Captions stand in place of the names of the views.
    options.captions = {"one", "two"};
    EXPECT_EQ(risorius::message_of([&] { animate::make_sheet(options); }),
              "captions: expected a caption for each of 3 columns, found 2");
    options.captions = {"", "", ""};
    animate::make_sheet(options);
    const Image bare = media::read_png(options.out);
    const auto ink_above = [&](const Image& image) {
        int dark = 0;
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < image.width_px; ++x) dark += image.pixel(x, y)[1] < 128;
        return dark;
    };
    EXPECT_GT(ink_above(sheet), 50);
    EXPECT_EQ(ink_above(bare), 0);
    options.captions = {};
    options.cameras = {"below"};
    EXPECT_NE(risorius::message_of([&] {
                  animate::make_sheet(options);
              }).find("cameras: expected one of"),
              std::string::npos);
}

TEST(StimulusOptions, OfNoUseTogetherAreRefusedWithTheirPlace) {
    const Folder folder;
    const std::string script = "render '" + smile_of(folder, "smile.json", 1).string() + "' ";
    const std::string wav = ramp_wav(folder).string(), here = folder.path().string();
    const auto refused = [&](const std::string& arguments) {
        const Outcome outcome = run(script + arguments, folder.path());
        EXPECT_EQ(outcome.code, 2) << arguments;
        return outcome.errors;
    };
    EXPECT_EQ(refused("-o a.mkv --crf 20"),
              "risorius: a.mkv: expected an ending whose quality (crf) can be chosen, .mp4, .mov "
              "or .webm, found \".mkv\"\n");
    EXPECT_EQ(refused("-o a.png --still 0 --audio '" + wav + "'"),
              "risorius: --audio: expected a video to encode, found --still\n");
    EXPECT_EQ(refused("-o a.mp4 --audio-offset 5"),
              "risorius: --audio-offset: expected a recording, by --audio, found none\n");
    EXPECT_EQ(refused("-o a.mp4 --audio '" + wav + "' --audio-offset -4000"),
              "risorius: --audio-offset: expected an offset with which the video contains some of "
              "the recording, found "
              "-4000 samples, -0.5 s\n");
    EXPECT_EQ(refused("-o a.mp4 --photodiode lower_left --photodiode-size 90"),
              "risorius: --photodiode-size: expected pixels in [2, 60], half the smaller side of "
              "the picture, found 90\n");
    EXPECT_EQ(refused("-o a.mp4 --frame-counter upper_left --frame-counter-size 6"),
              "risorius: --frame-counter-size: expected pixels in [2, 5], 24 cells side by side, "
              "found 6\n");
    EXPECT_EQ(refused("-o a.mp4 --passes depht"),
              "risorius: --passes: expected one of \"segmentation\", \"depth\", \"normals\", "
              "\"flow\", \"masks\" (did you mean \"depth\"?), found \"depht\"\n");
    EXPECT_EQ(refused("-o a.png --still 0 --passes flow"),
              "risorius: --passes: expected passes of one frame with --still, found \"flow\", to "
              "the next one\n");
    EXPECT_EQ(refused("-o a.mp4 --show error"),
              "risorius: --show error: expected a script to compare with, by --against, found "
              "none\n");
    EXPECT_EQ(refused("-o a.mp4 --scale 2"),
              "risorius: --scale: expected --show strain or error, which have one, found --show "
              "skin\n");
    EXPECT_EQ(refused("-o a.mp4 --shutter 400"),
              "risorius: --shutter: expected degrees in [0, 360], found 400\n");
    EXPECT_EQ(refused("-o a.mp4 --losless"),
              "risorius: render: expected only what risorius render --help lists (did you mean "
              "\"--lossless\"?), found \"--losless\"\n");
    EXPECT_EQ(run("figure mussels -o x", folder.path()).errors.substr(0, 17), "risorius: figure:");
    EXPECT_NE(run("figure mussels -o x", folder.path()).errors.find("(did you mean \"muscles\"?)"),
              std::string::npos);
    EXPECT_EQ(folder.listing(), (std::set<std::string>{"ramp.wav", "smile.json"}));
}

}  // namespace
}  // namespace risorius::scenario
