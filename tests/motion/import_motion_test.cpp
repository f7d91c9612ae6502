// SPDX-License-Identifier: MIT
// A recording becomes a script with few keys that plays it back.
#include "risorius/motion/import_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "motion/motion_samples.h"
#include "paths.h"
#include "risorius/blendshapes/detail/shape_animation.h"
#include "risorius/blendshapes/detail/shape_goals.h"
#include "risorius/blendshapes/detail/shape_weights.h"
#include "risorius/face/face.h"
#include "risorius/motion/reduce_keys.h"
#include "risorius/rig/rig_description.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/detail/curve.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"
#include "temporary_folder.h"

namespace risorius::motion {
namespace {

namespace fs = std::filesystem;
const fs::path kRig = fs::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json";

class ImportMotion : public testing::Test {
  protected:
    ImportReport import(const std::string& text, ImportOptions options = {}) {
        std::ofstream(folder_ / "take", std::ios::binary) << text;
        options.file = folder_ / "take";
        options.out = folder_ / "script.json";
        options.rig = kRig;
        const ImportReport report = import_motion(options);
        script_ = JsonCursor::read_file(options.out).json();
        return report;
    }
    /// The value of a channel of the script.
    double at(const std::string& channel, double t_s) const {
        std::vector<track::Key> keys;
        for (const Json& key : script_.at("channels").at(channel).at("keys"))
            keys.push_back({key[0].get<double>(), key[1].get<double>()});
        return track::Curve(keys, track::Interpolation::kLinear).at(t_s);
    }
    TemporaryFolder folder_;
    Json script_;
};

TEST(ReduceKeys, NoSampleIsFartherThanTheTolerance) {
    std::vector<double> times, values;
    for (int i = 0; i < 400; ++i) {
        times.push_back(i / 60.0 + 0.004 * std::sin(i));
        values.push_back(0.5 + 0.4 * std::sin(0.05 * i) * std::cos(0.011 * i));
    }
    std::size_t before = 401;
    for (const double tolerance : {0.0, 0.001, 0.01, 0.05}) {
        const std::vector<track::Key> keys = reduce_keys(times, values, tolerance);
        const track::Curve curve(keys, track::Interpolation::kLinear);
        for (std::size_t i = 0; i < times.size(); ++i)
            EXPECT_NEAR(curve.at(times[i]), values[i], tolerance + 1e-12) << tolerance;
        EXPECT_LT(keys.size(), before) << tolerance;
        before = keys.size();
    }
    EXPECT_LT(before, 20u);
    EXPECT_EQ(reduce_keys({0, 1, 2}, {0.3, 0.305, 0.3}, 0.01).size(), 1u);
}

TEST_F(ImportMotion, PlaysBackWithinTheToleranceByFewKeys) {
    const ImportReport report = import(arkit_sample());
    EXPECT_EQ(report.samples, 31);
    EXPECT_EQ(report.channels.size(), 5u);
    EXPECT_LT(report.keys(), report.values() / 2);
    EXPECT_EQ(script_.at("fps"), 30);
    EXPECT_TRUE(script_.at("channels").at("jawOpen").at("activation").get<bool>());
    for (int f = 0; f <= 30; ++f)
        EXPECT_NEAR(at("mouthSmileLeft", f / 30.0), moment(f / 30.0).smile_left, 0.0101);
    // The rig can play it: the muscles have their activation at once.
    const rig::RigDescription rig = rig::read_rig(kRig);
    const track::ScriptDescription script =
        track::read_script(folder_ / "script.json", rig.channels(), rig.facs, rig.expressions);
    const track::Drive drive = track::Timeline(script, rig.channels()).at(0.4);
    EXPECT_GT(drive.activation[rig.channels().column("zygomaticus_major", Side::kLeft)], 0.3);
    EXPECT_EQ(drive.excitation.cwiseAbs().maxCoeff(), 0);
}

TEST_F(ImportMotion, MirroredAndInvertedRecordingsAreTurnedBack) {
    import(mediapipe_sample(), {.mirror = true, .invert = {"pitch"}, .tolerance = 1e-4});
    EXPECT_NEAR(at("mouthSmileRight", 0.4), 0.8, 0.001);
    EXPECT_NEAR(at("mouthSmileLeft", 0.4), 0.3, 0.001);
    EXPECT_NEAR(at("head_yaw_deg", 0.3), -moment(0.3).yaw_deg, 0.01);
    EXPECT_NEAR(at("head_roll_deg", 0.6), -moment(0.6).roll_deg, 0.01);
    EXPECT_NEAR(at("head_pitch_deg", 0.6), -moment(0.6).pitch_deg, 0.01);
}

std::string webcam(const std::string& frames) { return "{\"frames\":[" + frames + "]}"; }
std::string frame(double t_s, double smile) {
    return "{\"t\":" + number_text(t_s, 4) +
           ",\"blendShapes\":{\"mouthSmileLeft\":" + number_text(smile, 5) + "}}";
}
std::string no_face(double t_s) {
    return "{\"t\":" + number_text(t_s, 4) + ",\"blendShapes\":null}";
}

TEST_F(ImportMotion, WithoutAFaceItHoldsAndThenFadesToRest) {
    std::string frames;
    for (int f = 0; f < 90; ++f)
        frames +=
            (f > 0 ? "," : "") + (f >= 30 && f < 60 ? no_face(f / 30.0) : frame(f / 30.0, 0.6));
    const ImportReport report = import(webcam(frames), {.tolerance = 1e-4});
    EXPECT_EQ(report.unseen, 30);
    EXPECT_GT(report.faded, 20);
    EXPECT_NEAR(at("mouthSmileLeft", 29 / 30.0 + kHold_s), 0.6, 0.001);
    EXPECT_NEAR(at("mouthSmileLeft", 29 / 30.0 + kHold_s + kFade_s / 2), 0.3, 0.03);
    EXPECT_NEAR(at("mouthSmileLeft", 1.7), 0, 1e-9);
    EXPECT_NEAR(at("mouthSmileLeft", 2.0), 0.6, 1e-9);
}

TEST_F(ImportMotion, LongGapsInTheTimesGoToRestAndShortOnesDoNot) {
    std::string frames;
    for (int f = 0; f < 120; ++f)
        if ((f < 20 || f >= 26) && (f < 40 || f >= 80))
            frames += (frames.empty() ? "" : ",") + frame(f / 30.0, 0.6);
    const ImportReport report = import(webcam(frames), {.tolerance = 1e-4});
    EXPECT_EQ(report.lost, 46);
    EXPECT_NEAR(at("mouthSmileLeft", 22 / 30.0), 0.6, 1e-9);
    EXPECT_NEAR(at("mouthSmileLeft", 60 / 30.0), 0, 1e-9);
    EXPECT_NEAR(at("mouthSmileLeft", 80 / 30.0), 0.6, 1e-3);
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_EQ(report.notes[0], "no samples from 1.3 to 2.667 s: the face goes to rest");
}

TEST_F(ImportMotion, NeutralIsTakenOff) {
    std::string frames;
    for (int f = 0; f < 60; ++f)
        frames += (f > 0 ? "," : "") + frame(f / 30.0, f < 30 ? 0.2 + 0.01 * (f % 3) : 0.7);
    import(webcam(frames), {.neutral_s = std::array{0.0, 0.5}, .tolerance = 1e-4});
    EXPECT_NEAR(at("mouthSmileLeft", 1.5), 0.7 - 0.21, 1e-4);
    EXPECT_NEAR(at("mouthSmileLeft", 0), 0, 1e-9);
    EXPECT_NE(message_of([&] {
                  import(webcam(frames), {.neutral_s = std::array { 5.0, 6.0 }});
              }).find("a time with samples of the face"),
              std::string::npos);
}

TEST_F(ImportMotion, SmoothingTakesNoiseAwayWithoutDelay) {
    std::string frames;
    for (int f = 0; f < 120; ++f)
        frames += (f > 0 ? "," : "") +
                  frame(f / 60.0, 0.3 + 0.2 * bump(f / 60.0, 0.5, 1.5) + (f % 2 ? 0.02 : -0.02));
    import(webcam(frames), {.smooth_hz = 6, .tolerance = 1e-4});
    for (int f = 20; f < 100; ++f)
        EXPECT_NEAR(at("mouthSmileLeft", f / 60.0), 0.3 + 0.2 * bump(f / 60.0, 0.5, 1.5), 0.004);
}

// What `risorius shapes` writes for other programs comes back: 240 frames of a sample, with few keys.
TEST_F(ImportMotion, TablesOfOurOwnComeBackWithATenthOfTheirValues) {
    const scene::RigFiles files = scene::read_rig_files(kRig);
    face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());
    const blendshapes::ShapeSet set =
        blendshapes::shape_set(files.rig, "arkit52", {}, "rig.json", "rig.json");
    const blendshapes::ShapeAnimation animation = blendshapes::bake_script(
        fs::path(RISORIUS_SOURCE_DIR) / "samples/hello/script.json", files, set.goals,
        blendshapes::ShapeWeights(face, files.rig.channels(), set.goals));
    const ImportReport report = import(blendshapes::live_link_table(animation));
    EXPECT_EQ(report.format, "livelink");
    EXPECT_EQ(report.samples, animation.weights.rows());
    EXPECT_EQ(report.fps, animation.fps);
    EXPECT_LT(10 * report.keys(), report.values()) << report.keys();
    RecordProperty("keys", static_cast<int>(report.keys()));
    for (std::size_t s = 0; s < animation.shapes.size(); ++s) {
        if (!script_.at("channels").contains(animation.shapes[s])) continue;
        for (long f = 0; f < animation.weights.rows(); ++f)
            EXPECT_NEAR(at(animation.shapes[s], static_cast<double>(f) / animation.fps),
                        animation.weights(f, static_cast<long>(s)), 0.0101)
                << animation.shapes[s];
    }
}

// Muscles that follow excitation would be late, and brows of dynamic tissue by 50 ms.
TEST_F(ImportMotion, LipsAndBrowsArriveWithinAFrameOfTheRecording) {
    constexpr double kFps = 30;
    std::string frames;
    for (int f = 0; f <= 30; ++f) {
        const double t_s = f / kFps;
        frames +=
            (f > 0 ? ",{\"t\":" : "{\"t\":") + number_text(t_s, 5) +
            ",\"blendShapes\":{\"mouthSmileLeft\":" + number_text(0.8 * bump(t_s, 0, 0.6), 5) +
            ",\"browInnerUp\":" + number_text(0.6 * bump(t_s, 0.3, 0.9), 5) + "}}";
    }
    import(webcam(frames));
    const scene::RigFiles files = scene::read_rig_files(kRig);
    const track::ChannelTable channels = files.rig.channels();
    const track::ScriptDescription script = track::read_script(
        folder_ / "script.json", channels, files.rig.facs, files.rig.expressions);
    const track::Timeline timeline(script, channels);
    face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());
    face.move(script.header.motion);
    const auto drive = [&](double t_s) { return timeline.at(t_s); };
    face.start(drive);
    const scene::LandmarkPoints points(face.head(), files.rig);
    struct Peak {
        const char* landmark;
        int frame;
    };
    for (const Peak& peak : {Peak{"ch_l", 9}, Peak{"bm_l", 18}}) {
        double most_m = 0;
        int at = 0;
        for (int f = peak.frame - 3; f <= peak.frame + 3; ++f) {
            const Points vertices = face.pose_at(f / kFps, drive).vertices;
            const double moved = (points.at(peak.landmark, vertices) -
                                  points.at(peak.landmark, face.head().vertices))
                                     .norm();
            if (moved > most_m) at = f;
            most_m = std::max(most_m, moved);
        }
        EXPECT_GT(most_m, 2e-3) << peak.landmark;
        EXPECT_LE(std::abs(at - peak.frame), 1) << peak.landmark;
    }
}

TEST_F(ImportMotion, SaysWhatTheRigDoesNotHave) {
    const ImportReport report = import(
        "{\"frames\":[{\"t\":0,\"blendShapes\":{\"jawOpen\":0.5,\"earWiggle\":1}},"
        "{\"t\":0.1,\"blendShapes\":{\"jawOpen\":1.5}}]}");
    EXPECT_EQ(report.unmapped, std::vector<std::string>{"earWiggle"});
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_EQ(report.notes[0], "jawOpen: 1 values outside of 0 to 1 are limited");
    EXPECT_EQ(message_of([&] {
                  import(arkit_sample(), {.invert = { "jaw" }});
              }).substr(0, 20),
              "invert: expected one");
}

}  // namespace
}  // namespace risorius::motion
