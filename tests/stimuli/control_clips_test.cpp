// SPDX-License-Identifier: MIT
// What controls of a clip show, with their tables, areas of interest and words for the paper.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "message_of.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/media/video_reader.h"
#include "risorius/stimuli/batch.h"
#include "stimuli/batch_fixture.h"

namespace risorius::stimuli {
namespace {

class ControlClips : public Batch {};

/// Clips of one smile with its controls, as the test below has made them.
struct SmileSet {
    fs::path out;
    Image frame(const std::string& control, int number = 2) const {
        return media::VideoReader(out / ("stimuli/stim-smile1" + control + "_video.mkv"))
            .frame(number);
    }
    animate::FrameRows table(const std::string& control, const char* name = "frames") const {
        const fs::path file =
            out / ("stimuli/stim-smile1" + control + "_annot-" + name + "_events.tsv");
        return fs::exists(file) ? animate::frame_rows(text_of(file)) : animate::FrameRows{};
    }
};

/// Where the tip of the nose is in frame 2.
std::pair<int, int> nose_of(const animate::FrameRows& rows) {
    const int u = rows.column("prn.u_px");
    return {static_cast<int>(rows.number(2, u)), static_cast<int>(rows.number(2, u + 1))};
}

void expect_changes_in_the_oval_alone(const SmileSet& set) {
    const Image plain = set.frame(""), oval = set.frame("Oval");
    const auto [nose_x, nose_y] = nose_of(set.table(""));
    EXPECT_TRUE(std::equal(oval.pixel(nose_x, nose_y), oval.pixel(nose_x, nose_y) + 3,
                           plain.pixel(nose_x, nose_y)));
    const int neck_y = 62;
    EXPECT_NE(plain.pixel(24, neck_y)[0], 128) << "the neck";
    EXPECT_EQ(oval.pixel(24, neck_y)[0], 128);
    for (const char* clip : {"LowPass3", "HighPass3", "Noise0"}) {
        const Image image = set.frame(clip);
        int changed = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 48; ++x) {
                const int difference = std::abs(image.pixel(x, y)[1] - plain.pixel(x, y)[1]);
                changed += difference > 2;
                if (y == neck_y || y < 3) {
                    EXPECT_LE(difference, 1) << clip << " " << x << " " << y;
                }
            }
        EXPECT_GT(changed, 200) << clip;
    }
}

/// The pictures, and the table with them.
void expect_mirrored(const SmileSet& set) {
    const Image plain = set.frame(""), mirrored = set.frame("Mirrored");
    const animate::FrameRows rows = set.table(""), other = set.table("Mirrored");
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 48; ++x) ASSERT_EQ(mirrored.pixel(x, y)[1], plain.pixel(47 - x, y)[1]);
    const auto cell = [](const animate::FrameRows& of, const char* column) {
        return of.number(2, of.column(column));
    };
    EXPECT_NEAR(cell(other, "ch_l.u_px"), 48 - cell(rows, "ch_r.u_px"), 1e-3);
    EXPECT_EQ(cell(other, "ch_l.v_px"), cell(rows, "ch_r.v_px"));
    EXPECT_EQ(cell(other, "ch_l.x_mm"), -cell(rows, "ch_r.x_mm"));
    EXPECT_EQ(cell(other, "activation.zygomaticus_major.l"),
              cell(rows, "activation.zygomaticus_major.r"));
}

/// Areas of interest follow the picture.
void expect_areas(const SmileSet& set) {
    const animate::FrameRows aois = set.table("", "aois"), mirrored = set.table("Mirrored", "aois");
    ASSERT_EQ(aois.rows(), 3 * 5);
    EXPECT_EQ(aois.cells[1][3], "mouth");
    EXPECT_EQ(aois.cells[1][4], "1");
    EXPECT_GT(aois.number(3 * 4 + 1, 5), 1.1 * aois.number(1, 5)) << "a smile widens the mouth";
    EXPECT_GT(std::stod(aois.cells[0][6]), 24) << "the left eye is on the right";
    EXPECT_GT(std::stod(mirrored.cells[0][6]), 24);
    EXPECT_EQ(set.table("Mondrian", "aois").rows(), 0);
    const Json key_frames = Json::parse(text_of(set.out / "aois/smile1_tobii.json"));
    EXPECT_EQ(key_frames.at("aois").at(1).at("name"), "mouth");
    EXPECT_EQ(key_frames.at("aois").at(1).at("key_frames").at(0).at("time"), 0);
    EXPECT_GE(key_frames.at("aois").at(1).at("key_frames").size(), 2u);
    // Lines of the mouth for Data Viewer: "-start -end FREEHAND 2 x,y ... mouth", which cover the 0.5 s without a gap
    std::istringstream ias(text_of(set.out / "aois/smile1.ias"));
    long next_ms = 0;
    for (std::string line; std::getline(ias, line);) {
        if (!line.ends_with(" mouth")) continue;
        long start_ms = 0, end_ms = 0;
        ASSERT_EQ(std::sscanf(line.c_str(), "%ld %ld FREEHAND 2 ", &start_ms, &end_ms), 2) << line;
        EXPECT_EQ(-start_ms, next_ms);
        next_ms = -end_ms + 1;
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), 10) << line;
    }
    EXPECT_EQ(next_ms, 500);
    const std::string page = text_of(set.out / "index.html");
    EXPECT_NE(page.find("<polygon points=\"" + aois.cells[1][6] + "\""), std::string::npos);
}

/// The paragraph for the paper names what was made, and tags say what is seen.
void expect_methods(const SmileSet& set) {
    const std::string methods = text_of(set.out / "methods.md");
    for (const char* part :
         {"8 video clips (1 condition, 7 controls) of 1 synthetic head",
          "48 x 64 pixels at 10 frames", "lasted 0.5 s", "Luminance was not matched.",
          "- 1 clip `low_pass`: only spatial frequencies below 3 cycles per face",
          "Butterworth filter of order 4", "(compiled with ",
          "were grown by 3 % of the width of the face.", "@article{costen1996,", "[Participants"})
        EXPECT_NE(methods.find(part), std::string::npos) << part << "\n" << methods;
    const animate::FrameRows clips = animate::frame_rows(text_of(set.out / "stimuli/stimuli.tsv"));
    const auto hed = static_cast<std::size_t>(clips.column("HED"));
    EXPECT_EQ(clips.cells[0][hed],
              "Sensory-event, Experimental-stimulus, Visual-presentation, (Video-clip, (Animation, "
              "(Face, Happy)))");
    EXPECT_FALSE(Json::parse(text_of(set.out / "stimuli/stimuli.json")).contains("HED"))
        << "the validator of HED forbids this key";
    EXPECT_EQ(clips.cells[6][hed].find("Face"), std::string::npos) << "a Mondrian";
}

/// A mask changes, and has no landmarks and no moments.
void expect_mask(const SmileSet& set) {
    EXPECT_LT(set.table("Mondrian").column("ch_l.u_px"), 0);
    EXPECT_NE(set.frame("Mondrian").rgba, set.frame("Mondrian", 1).rgba);
    const Json sidecar = Json::parse(text_of(set.out / "stimuli/stim-smile1Mondrian_video.json"));
    EXPECT_TRUE(sidecar.at("movement_onset_frame").is_null());
    EXPECT_TRUE(sidecar.at("motion").at("seen_mm").is_null());
}

/// Five dots on landmarks, and background.
void expect_dots(const SmileSet& set) {
    const Image dots = set.frame("PointLight");
    const auto [nose_x, nose_y] = nose_of(set.table(""));
    EXPECT_GT(dots.pixel(nose_x, nose_y)[1], 230);
    int bright = 0, background = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 48; ++x) {
            bright += dots.pixel(x, y)[1] > 200;
            background += dots.pixel(x, y)[1] == 128;
        }
    EXPECT_GE(bright, 5);
    EXPECT_LT(bright, 5 * 16);
    EXPECT_GT(background, 48 * 64 - 5 * 30);
}

/// How far a landmark has come in each frame, of its farthest way.
std::vector<double> shares_of(const animate::FrameRows& rows, const std::string& landmark) {
    std::vector<double> out;
    for (int frame = 0; frame < rows.rows(); ++frame) {
        double squares = 0;
        for (const char* axis : {".x_mm", ".y_mm", ".z_mm"}) {
            const int at = rows.column(landmark + axis);
            squares += std::pow(rows.number(frame, at) - rows.number(0, at), 2);
        }
        out.push_back(std::sqrt(squares));
    }
    const double most = *std::max_element(out.begin(), out.end());
    for (double& share : out) share /= most;
    return out;
}

/// The steps of a rise from 5 to 95 %.
std::vector<double> steps_of(const std::vector<double>& shares) {
    std::vector<double> out;
    for (std::size_t i = 1; i < shares.size() && shares[i] < 0.95; ++i)
        if (shares[i - 1] > 0.05) out.push_back(shares[i] - shares[i - 1]);
    return out;
}

/// The largest step over the mean one.
double unevenness(const std::vector<double>& steps) {
    return *std::max_element(steps.begin(), steps.end()) * static_cast<double>(steps.size()) /
           std::accumulate(steps.begin(), steps.end(), 0.0);
}

/// The same way with the same onset and apex, and a speed that is the profile's.
void expect_speeds(const SmileSet& set) {
    const auto sidecar = [&](const char* clip) {
        return Json::parse(
            text_of(set.out / ("stimuli/stim-smile1" + std::string(clip) + "_video.json")));
    };
    const Json plain = sidecar("");
    const std::string landmark = plain.at("motion").at("seen_landmark").get<std::string>();
    const auto steps = [&](const char* clip) {
        return steps_of(shares_of(set.table(clip), landmark));
    };
    for (const char* clip : {"ConstantSpeed", "AcceleratedSpeed", "DeceleratedSpeed"}) {
        const Json changed = sidecar(clip);
        EXPECT_NEAR(changed.at("motion").at("seen_mm").get<double>(),
                    plain.at("motion").at("seen_mm").get<double>(), 0.05)
            << clip;
        EXPECT_LE(std::abs(changed.at("apex_frame").get<int>() - plain.at("apex_frame").get<int>()),
                  1)
            << clip;
        EXPECT_EQ(changed.at("frames"), plain.at("frames"));
        ASSERT_GE(steps(clip).size(), 3u) << clip;
    }
    // A natural movement is fastest in its middle.
    EXPECT_LT(unevenness(steps("ConstantSpeed")), 1.2);
    EXPECT_GT(unevenness(steps("")), 1.3);
    const auto last_over_first = [&](const char* clip) {
        return steps(clip).back() / steps(clip).front();
    };
    EXPECT_GT(last_over_first("AcceleratedSpeed"), 1.5);
    EXPECT_LT(last_over_first("DeceleratedSpeed"), 1 / 1.5);
}

TEST_F(ControlClips, ChangeTheSpeedAlone) {
    Json json = Json::parse(text_of(design("speed.json", {1}, R"([
        {"control": "speed", "profile": "constant"}, {"control": "speed", "profile": "accelerated"},
        {"control": "speed", "profile": "decelerated"}])")));
    json["clips"].erase("photodiode");
    json["clips"]["quality"] = "draft";
    json["sets"][0]["script"]["fps"] = 30;
    std::ofstream(folder().path() / "speed.json") << json.dump();
    const BatchOptions options{
        .design = folder().path() / "speed.json", .out = folder().path() / "speed", .workers = 2};
    EXPECT_EQ(make_batch(options).made, 4);
    expect_speeds({options.out});
}

TEST_F(ControlClips, ShowWhatTheySay) {
    Json json = Json::parse(text_of(design("oval.json", {1}, R"([
        {"control": "low_pass", "cycles_per_face": 3}, {"control": "high_pass", "cycles_per_face": 3},
        {"control": "noise", "snr_db": 0}, "oval", "mirrored", "mondrian",
        {"control": "point_light", "dots": 5, "radius": 0.06}])")));
    json["clips"].erase("photodiode");
    json["clips"]["aois"] = {"eye_l", "mouth", "face"};
    json["clips"]["quality"] = "draft";
    std::ofstream(folder().path() / "oval.json") << json.dump();
    const BatchOptions options{
        .design = folder().path() / "oval.json", .out = folder().path() / "oval", .workers = 2};
    EXPECT_EQ(make_batch(options).made, 8);
    const SmileSet set{options.out};
    expect_changes_in_the_oval_alone(set);
    expect_mirrored(set);
    expect_areas(set);
    expect_mask(set);
    expect_dots(set);
    expect_methods(set);
    // What its name does not tell changes a control, too
    const std::string before = plan_batch(options.design).clips[7].content_sha256;
    json["sets"][0]["controls"][6]["dots"] = 6;
    std::ofstream(folder().path() / "oval.json") << json.dump();
    EXPECT_NE(plan_batch(options.design).clips[7].content_sha256, before);
    json["sets"][0]["controls"] = Json::parse(R"([{"control": "mondrian", "rate_hz": 3}])");
    std::ofstream(folder().path() / "oval.json") << json.dump();
    EXPECT_NE(message_of([&] { make_batch(options); })
                  .find("expected a rate_hz that divides the frames per second, for the control "
                        "mondrian, found 3 at 10 fps"),
              std::string::npos);
    json["sets"][0]["controls"] =
        Json::parse(R"([{"control": "low_pass", "cycles_per_face": 30}])");
    std::ofstream(folder().path() / "oval.json") << json.dump();
    EXPECT_NE(message_of([&] {
                  make_batch(options);
              }).find("expected a face of 120 px or more for cycles_per_face 30"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::stimuli
