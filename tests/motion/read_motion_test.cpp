// SPDX-License-Identifier: MIT
// Each format of a face tracker gives back the motion that was written into it, in the terms of scripts.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <fstream>
#include <random>
#include <sstream>

#include "message_of.h"
#include "motion/motion_samples.h"
#include "paths.h"
#include "risorius/io/morph_model.h"
#include "risorius/motion/import_motion.h"
#include "temporary_folder.h"

namespace risorius::motion {
namespace {

namespace fs = std::filesystem;

class ReadMotion : public testing::Test {
  protected:
    RecordedMotion read(const std::string& name, const std::string& text,
                        const ReadMotionOptions& options = {}) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return read_motion(folder_ / name, options);
    }
    std::string complaint(const std::string& name, const std::string& text) const {
        std::string said = message_of([&] { read(name, text); });
        const std::string here = folder_.path().string() + "/";
        if (const std::size_t at = said.find(here); at != std::string::npos)
            said.erase(at, here.size());
        return said;
    }
    TemporaryFolder folder_;
};

/// Largest difference of a channel from what happened, over the samples with a face.
double error_of(const RecordedMotion& motion, const std::string& channel,
                double (*truth)(const Moment&)) {
    const RecordedTrack* track = motion.find(channel);
    if (track == nullptr) return 1e9;
    double most = 0;
    for (std::size_t i = 0; i < motion.times_s.size(); ++i)
        if (motion.seen[i])
            most = std::max(most, std::abs(track->values[i] - truth(moment(motion.times_s[i]))));
    return most;
}

void expect_head(const RecordedMotion& motion, double within_deg) {
    EXPECT_LT(error_of(motion, "head_yaw_deg", [](const Moment& m) { return m.yaw_deg; }),
              within_deg);
    EXPECT_LT(error_of(motion, "head_pitch_deg", [](const Moment& m) { return m.pitch_deg; }),
              within_deg);
    EXPECT_LT(error_of(motion, "head_roll_deg", [](const Moment& m) { return m.roll_deg; }),
              within_deg);
}

void expect_shapes(const RecordedMotion& motion, double within) {
    EXPECT_LT(error_of(motion, "mouthSmileLeft", [](const Moment& m) { return m.smile_left; }),
              within);
    EXPECT_LT(error_of(motion, "mouthSmileRight", [](const Moment& m) { return m.smile_right; }),
              within);
    EXPECT_LT(error_of(motion, "jawOpen", [](const Moment& m) { return m.jaw_open; }), within);
    EXPECT_LT(error_of(motion, "browInnerUp", [](const Moment& m) { return m.brow; }), within);
}

std::string code_text(int hours, int minutes, int seconds, int frame, char separator,
                      int fraction) {
    char text[64];
    std::snprintf(text, sizeof text, "%02d:%02d:%02d%c%02d.%03d", hours, minutes, seconds,
                  separator, frame, fraction);
    return text;
}

TEST_F(ReadMotion, LiveLinkGoesByNameThroughMidnightAndLostFrames) {
    // 23:59:59 frame 17 to the next day; the fractions of frames run unevenly.
    const auto code = [](int f) {
        const int at = 17 + f;
        return code_text(at < 60 ? 23 : 0, at < 60 ? 59 : 0, at < 60 ? 59 : 0, at % 60, ':',
                         37 * f % 1000);
    };
    const RecordedMotion motion =
        read("take.csv", live_link_sample(61, 60, code, [](int f) { return f == 31 || f == 32; }));
    EXPECT_EQ(motion.format, "livelink");
    EXPECT_EQ(motion.times_s.size(), 59u);
    EXPECT_EQ(motion.lost, 2);
    EXPECT_NEAR(motion.times_s.back(), 1.0, 1e-9);
    EXPECT_EQ(motion.fps, 60);
    expect_shapes(motion, 1e-7);
    expect_head(motion, 1e-5);
    EXPECT_LT(error_of(motion, "gaze_yaw_deg.r", [](const Moment& m) { return m.gaze_deg; }), 1e-5);
    EXPECT_EQ(motion.find("eyeLookOutLeft"), nullptr);  // the angles of the eyes say it
}

TEST_F(ReadMotion, DropFrameCodesSkipNumbersAtTheMinute) {
    // 29.97 frames a second: after 00:00:59;29 comes 00:01:00;02.
    const auto code = [](int f) {
        const int at = 20 + f;
        return at < 30 ? code_text(0, 0, 59, at, ';', 0)
                       : code_text(0, 1, (at - 28) / 30, (at - 28) % 30, ';', 0);
    };
    const RecordedMotion motion =
        read("drop.csv", live_link_sample(29, 30 / 1.001, code, [](int) { return false; }));
    EXPECT_EQ(motion.lost, 0);
    EXPECT_NEAR(motion.fps, 30 / 1.001, 1e-9);
    EXPECT_NEAR(motion.times_s.back(), 28 * 1.001 / 30, 1e-9);
    expect_shapes(motion, 1e-7);
}

TEST_F(ReadMotion, PlainTimesAreFramesOrMilliseconds) {
    const auto never = [](int) { return false; };
    const RecordedMotion frames =
        read("frames.csv",
             live_link_sample(
                 31, 30, [](int f) { return std::to_string(900 + f); }, never),
             {.fps = 30});
    EXPECT_NEAR(frames.times_s.back(), 1, 1e-9);
    const RecordedMotion ms =
        read("ms.csv", live_link_sample(
                           31, 50, [](int f) { return std::to_string(5000 + 20 * f); }, never));
    EXPECT_NEAR(ms.times_s.back(), 0.6, 1e-9);
    EXPECT_NEAR(ms.fps, 50, 1e-6);
    expect_shapes(ms, 1e-7);
}

TEST_F(ReadMotion, MediaPipeHasMatricesByColumnsAndFramesWithoutAFace) {
    const RecordedMotion motion = read("web.jsonl", mediapipe_sample());
    EXPECT_EQ(motion.format, "mediapipe");
    ASSERT_EQ(motion.times_s.size(), 31u);
    EXPECT_EQ(motion.seen[15], 0);
    EXPECT_NEAR(motion.fps, 30, 1e-6);
    EXPECT_TRUE(motion.unmapped.empty());
    expect_shapes(motion, 1e-5);
    expect_head(motion, 1e-4);
}

TEST_F(ReadMotion, ArkitLeavesOutWhatIsZero) {
    const RecordedMotion motion = read("take.json", arkit_sample());
    EXPECT_EQ(motion.format, "arkit");
    expect_shapes(motion, 1e-5);
    EXPECT_LT(error_of(motion, "eyeLookOutLeft", [](const Moment& m) { return m.gaze_deg / 35; }),
              1e-5);
    EXPECT_EQ(motion.find("head_yaw_deg"), nullptr);
}

TEST_F(ReadMotion, OpenFaceSeesGazeFromTheCameraAndFailsInSomeRows) {
    const RecordedMotion motion = read("openface.csv", openface_sample());
    EXPECT_EQ(motion.format, "openface");
    EXPECT_EQ(motion.seen[15] + motion.seen[16], 0);
    const double rad3 = 0.0005 / kRad + 1e-6;  // angles have three decimals, times too
    EXPECT_LT(error_of(motion, "head_yaw_deg", [](const Moment& m) { return m.yaw_deg; }),
              rad3 + 0.02);
    EXPECT_LT(error_of(motion, "head_pitch_deg", [](const Moment& m) { return m.pitch_deg; }),
              rad3 + 0.02);
    EXPECT_LT(error_of(motion, "head_roll_deg", [](const Moment& m) { return m.roll_deg; }),
              rad3 + 0.02);
    EXPECT_LT(error_of(motion, "gaze_yaw_deg.l", [](const Moment& m) { return m.gaze_deg; }),
              2 * rad3 + 0.1);
    EXPECT_LT(error_of(motion, "gaze_pitch_deg.r", [](const Moment&) { return 0.0; }), 2 * rad3);
    EXPECT_LT(error_of(motion, "AU12", [](const Moment& m) { return m.smile_left; }),
              0.001 + 0.003);
    EXPECT_LT(error_of(motion, "AU1", [](const Moment& m) { return m.brow; }), 0.001 + 0.003);
    EXPECT_EQ(error_of(motion, "AU26", [](const Moment&) { return 0.0; }),
              0);  // said not to be there
    EXPECT_EQ(motion.find("AU28")->values.back(), 1);
}

TEST_F(ReadMotion, PyFeatHasEmptyCellsAndNoTimes) {
    const RecordedMotion motion = read("fex.csv", pyfeat_sample());
    EXPECT_EQ(motion.format, "pyfeat");
    EXPECT_EQ(motion.seen[3], 0);
    EXPECT_NEAR(motion.times_s.back(), 1, 1e-9);
    expect_head(motion, 0.001);
    EXPECT_LT(error_of(motion, "AU12", [](const Moment& m) { return m.smile_left; }), 1e-4);
    EXPECT_NEAR(read("fex.csv", pyfeat_sample(), {.fps = 60}).times_s.back(), 0.5, 1e-9);
}

TEST_F(ReadMotion, VmcCountsAtApply) {
    const RecordedMotion motion = read("take.oscdump", vmc_sample());
    EXPECT_EQ(motion.format, "vmc");
    ASSERT_EQ(motion.times_s.size(), 11u);
    EXPECT_LT(error_of(motion, "mouthSmileLeft", [](const Moment& m) { return m.smile_left; }),
              1e-6);
    EXPECT_LT(error_of(motion, "eyeBlinkLeft", [](const Moment& m) { return m.brow; }), 1e-6);
    EXPECT_LT(error_of(motion, "head_yaw_deg", [](const Moment& m) { return m.yaw_deg; }), 1e-4);
    EXPECT_EQ(motion.unmapped, std::vector<std::string>{"Joy"});
}

TEST_F(ReadMotion, BvhTurnsInTheOrderOfItsChannels) {
    const RecordedMotion motion = read("head.bvh", bvh_sample());
    EXPECT_EQ(motion.format, "bvh");
    EXPECT_NEAR(motion.fps, 30, 1e-3);
    expect_head(motion, 0.001);
}

TEST_F(ReadMotion, GlTfHasWeightsByName) {
    io::MorphModel model;
    model.name = "head";
    model.vertices = Points::Zero(3, 3);
    model.vertices(1, 0) = model.vertices(2, 1) = 1;
    io::MorphPart part;
    part.name = "skin";
    part.triangles.resize(1, 3);
    part.triangles << 0, 1, 2;
    model.parts = {part};
    for (const char* name : {"mouthSmile_L", "jawOpen", "wiggle"})
        model.targets.push_back({name, {0}, Points::Ones(1, 3)});
    io::MorphAnimation& animation = model.animations.emplace_back();
    animation.fps = 30;
    animation.weights.resize(31, 3);
    for (int f = 0; f <= 30; ++f) {
        const Moment now = moment(f / 30.0);
        animation.weights.row(f) << static_cast<float>(now.smile_left),
            static_cast<float>(now.jaw_open), 1;
    }
    const RecordedMotion motion = read("head.glb", io::glb_bytes(model));
    EXPECT_EQ(motion.format, "gltf");
    EXPECT_NEAR(motion.fps, 30, 1e-3);
    EXPECT_LT(error_of(motion, "mouthSmileLeft", [](const Moment& m) { return m.smile_left; }),
              1e-5);
    EXPECT_LT(error_of(motion, "jawOpen", [](const Moment& m) { return m.jaw_open; }), 1e-5);
    EXPECT_EQ(motion.unmapped, std::vector<std::string>{"wiggle"});
}

std::string base64(const std::vector<float>& numbers) {
    std::string bytes(numbers.size() * 4, '\0'), out;
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits =
                bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (int k = 3; k >= 0; --k) out += kDigits[bits >> 6 * k & 63];
    }
    for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k) out[out.size() - 1 - k] = '=';
    return out;
}

// An expression's weight is the x of a node's translation; the head is a bone, and has a pose at rest.
TEST_F(ReadMotion, VrmAnimationsMoveNodes) {
    const float half = 0.70710678f;  // a quarter turn about x at rest
    std::vector<float> numbers{0, 0.5f, 1, 0, 0, 0, 0.25f, 0, 0, 1, 0, 0};
    for (const double yaw : {0.0, 10.0, 20.0}) {
        const Eigen::Quaterniond q =
            Eigen::Quaterniond(half, half, 0, 0) *
            Eigen::Quaterniond(Eigen::AngleAxisd(kRad * yaw, Vec3::UnitY()));
        for (const double x : {q.x(), q.y(), q.z(), q.w()})
            numbers.push_back(static_cast<float>(x));
    }
    const std::string text =
        R"({"asset":{"version":"2.0"},"nodes":[{"name":"n"},{"name":"b","rotation":[0.70710678,0,0,0.70710678]}],
        "extensions":{"VRMC_vrm_animation":{"specVersion":"1.0",
          "expressions":{"preset":{"blink":{"node":0}}},"humanoid":{"humanBones":{"head":{"node":1}}}}},
        "buffers":[{"byteLength":96,"uri":"data:application/octet-stream;base64,)" +
        base64(numbers) +
        R"("}],"bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":36},
          {"buffer":0,"byteOffset":48,"byteLength":48}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},
          {"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},
          {"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"}],
        "animations":[{"samplers":[{"input":0,"output":1},{"input":0,"output":2}],
          "channels":[{"sampler":0,"target":{"node":0,"path":"translation"}},
                      {"sampler":1,"target":{"node":1,"path":"rotation"}}]}]})";
    const RecordedMotion motion = read("wave.vrma", text);
    ASSERT_EQ(motion.times_s.size(), 3u);
    for (const char* side : {"eyeBlinkLeft", "eyeBlinkRight"}) {
        ASSERT_NE(motion.find(side), nullptr);
        EXPECT_EQ(motion.find(side)->values, (std::vector<double>{0, 0.25, 1}));
    }
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(motion.find("head_yaw_deg")->values[static_cast<std::size_t>(k)], 10.0 * k,
                    1e-4);
}

TEST_F(ReadMotion, WrongFilesSayWhereAndWhy) {
    EXPECT_EQ(
        complaint("x.csv", "a,b\n1,2\n"),
        "x.csv: expected recorded motion of a format that as lists, found another kind of file");
    EXPECT_EQ(complaint("x.csv", "Timecode,JawOpen\n10:00:61:00,0\n"),
              "x.csv: line 2, column Timecode: expected a time HH:MM:SS:FF.fff, or a number, found "
              "\"10:00:61:00\"");
    EXPECT_EQ(complaint("x.csv", "Timecode,JawOpen\n10:00:01:00,x\n"),
              "x.csv: line 2, column JawOpen: expected a number, found \"x\"");
    EXPECT_EQ(
        complaint("x.oscdump", "0.0 2f564d43\n"),
        "x.oscdump: line 1: expected a text that ends within its packet, found one that does not");
    EXPECT_EQ(complaint("x.bvh",
                        "HIERARCHY\nROOT Hips\n{\nCHANNELS 3 Xrotation Yrotation Zrotation\n}\n"
                        "MOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0\n"),
              "x.bvh: expected a joint with \"head\" in its name, found none");
    EXPECT_EQ(complaint("x.bvh",
                        "HIERARCHY\nROOT head\n{\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
                        "CHANNELS 1 Zrotation\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0 0\n"),
              "x.bvh: line 5: expected the channels of a joint once, found twice");
    EXPECT_EQ(complaint("x.jsonl", "{\"timestampMs\": 0, \"faceBlendshapes\": []}\n"),
              "x.jsonl: expected a face in some sample, found none in any");
    std::string names = "{\"frames\": [{\"t\": 0, \"blendShapes\": {\"a\": 0";
    for (int i = 0; i < 150000; ++i) names += ", \"a" + std::to_string(i) + "\": 0";
    const std::clock_t begin = std::clock();
    EXPECT_NE(complaint("x.json", names + "}}]}\n").find("at most 10000 keys in an object"),
              std::string::npos);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 2);
}

// Every file is read or refused; none makes the program crash or wait.
TEST_F(ReadMotion, ChangedFilesAreReadOrRefused) {
    const auto code = [](int f) { return "10:00:00:" + std::to_string(f); };
    const std::string samples[] = {
        live_link_sample(6, 60, code, [](int) { return false; }).substr(0, 6000),
        mediapipe_sample().substr(0, 9000),
        arkit_sample(),
        openface_sample(),
        pyfeat_sample(),
        vmc_sample(),
        bvh_sample()};
    const std::string formats[] = {"livelink", "mediapipe", "arkit", "openface",
                                   "pyfeat",   "vmc",       "bvh"};
    std::mt19937 random(20051);  // arbitrary
    int read_well = 0, refused = 0;
    for (int round = 0; round < 60; ++round)
        for (std::size_t s = 0; s < std::size(samples); ++s) {
            std::string text = samples[s];
            for (int changes = 1 + static_cast<int>(random() % 4); changes > 0; --changes) {
                const std::size_t at = random() % text.size();
                constexpr const char* kPieces[] = {"9e99", "-", ",",      "\n",  "[",
                                                   "}",    ":", "1e-300", "\xff"};
                if (random() % 3 == 0)
                    text.erase(at, 1 + random() % 40);
                else
                    text.replace(at, 1, kPieces[random() % std::size(kPieces)]);
                if (text.empty()) text = " ";
            }
            try {
                RecordedMotion motion = read("changed", text, {.as = formats[s]});
                ImportReport report;
                prepare_motion(motion, {.smooth_hz = 7}, report);
                ++read_well;
            } catch (const Error&) {
                ++refused;
            }
        }
    EXPECT_GT(read_well, 20);
    EXPECT_GT(refused, 20);
}

/// The truth of the shared samples, by column.
class SharedMotion : public testing::Test {
  protected:
    void SetUp() override {
        if (!fs::exists(kFolder / "truth.tsv")) GTEST_SKIP() << "no motion beside the project";
        std::ifstream in(kFolder / "truth.tsv");
        std::string line, cell;
        for (bool header = true; std::getline(in, line); header = false) {
            std::istringstream cells(line);
            for (std::size_t c = 0; std::getline(cells, cell, '\t'); ++c)
                if (header)
                    columns_.push_back({cell, {}});
                else
                    columns_[c].second.push_back(std::stod(cell));
        }
    }
    double truth(const std::string& name, double t_s) const {
        for (const auto& [column, values] : columns_)
            if (column == name) return values.at(static_cast<std::size_t>(std::lround(60 * t_s)));
        throw std::out_of_range(name);
    }
    /// Compares every column of the truth that the recording has; returns their number.
    int compare(const std::string& file, double weight, double angle_deg,
                const ReadMotionOptions& options = {}) const {
        const RecordedMotion motion = read_motion(kFolder / file, options);
        int compared = 0;
        for (const auto& [column, values] : columns_) {
            const RecordedTrack* track = motion.find(column);
            if (!track && column == "gaze_yaw_deg") track = motion.find("gaze_yaw_deg.l");
            if (!track) continue;
            ++compared;
            for (std::size_t i = 0; i < motion.times_s.size(); ++i)
                if (motion.seen[i]) {
                    EXPECT_NEAR(track->values[i], truth(column, motion.times_s[i]),
                                track->is_angle() ? angle_deg : weight)
                        << file << ", " << column << ", " << motion.times_s[i] << " s";
                }
        }
        return compared;
    }
    const fs::path kFolder = fs::path(RISORIUS_SHARED_DIR) / "data/motion";
    std::vector<std::pair<std::string, std::vector<double>>> columns_;
};

TEST_F(SharedMotion, IsWhatItsTruthSays) {
    EXPECT_EQ(compare("live_link_face.csv", 1e-3, 0.01), 13);
    EXPECT_EQ(compare("arkit.json", 1e-3, 0.01), 11);
    EXPECT_EQ(compare("mediapipe.jsonl", 1e-3, 0.01), 14);
    EXPECT_EQ(compare("openface.csv", 1e-3, 0.06), 4);  // three decimals of a rad, gaze two of them
    EXPECT_EQ(compare("pyfeat.csv", 1e-3, 0.01, {.fps = 60}), 3);
    EXPECT_EQ(compare("vmc.oscdump", 1e-3, 0.01), 14);
    EXPECT_EQ(compare("head.bvh", 1e-3, 0.01), 3);
}

}  // namespace
}  // namespace risorius::motion
