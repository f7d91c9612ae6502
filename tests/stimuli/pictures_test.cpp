// SPDX-License-Identifier: MIT
// Sets of pictures: the frame at the apex or at a given time, with its ground truth, controls, triggers and programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "message_of.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_reader.h"
#include "risorius/stimuli/batch.h"
#include "risorius/stimuli/detail/seen_motion.h"
#include "stimuli/batch_fixture.h"

namespace risorius::stimuli {
namespace {

class Pictures : public Batch {
  protected:
    /// The design of the fixture with other options of clips, and controls.
    static Json pictures(const std::string& controls, const std::string& clips) {
        Json json = Json::parse(text_of(design("pictures.json", {1}, controls)));
        json["clips"] = Json::parse(clips);
        return json;
    }
    static BatchOptions options_of(const Json& json, const std::string& name) {
        const fs::path file = folder().path() / (name + ".json");
        std::ofstream(file) << json.dump();
        return {.design = file, .out = folder().path() / name, .workers = 1};
    }
    static animate::FrameRows table(const BatchOptions& set, const std::string& clip) {
        const fs::path file = set.out / ("stimuli/stim-" + clip + "_annot-frames_events.tsv");
        if (!fs::exists(file)) throw std::runtime_error(file.string() + " is not there");
        return animate::frame_rows(text_of(file));
    }
    static Json sidecar(const BatchOptions& set, const std::string& file) {
        return Json::parse(text_of(set.out / ("stimuli/stim-" + file + ".json")));
    }
    static Image picture(const BatchOptions& set, const std::string& clip) {
        return media::read_png(set.out / ("stimuli/stim-" + clip + "_image.png"));
    }
    static constexpr const char* kPng =
        R"({"quality": "preview", "ending": "png", "shown_s": 0.4, "aois": ["mouth"]})";
};

TEST_F(Pictures, ShowTheApexOfTheVideo) {
    const BatchOptions set = options_of(
        pictures(R"(["mirrored", "neutral", {"control": "low_pass", "cycles_per_face": 3}])", kPng),
        "stills");
    EXPECT_EQ(make_batch(set).made, 4);
    const BatchOptions video =
        options_of(pictures("[]", R"({"quality": "preview", "ending": "mkv"})"), "film");
    EXPECT_EQ(make_batch(video).made, 1);

    // The same picture as frame `apex` of the video, and the same measures
    const Json still = sidecar(set, "smile1_image"), film = sidecar(video, "smile1_video");
    const int apex = film.at("apex_frame").get<int>();
    EXPECT_GT(apex, 2);
    const Image shown = picture(set, "smile1");
    EXPECT_EQ(shown.rgba,
              media::VideoReader(video.out / "stimuli/stim-smile1_video.mkv").frame(apex).rgba);
    const animate::FrameRows one = table(set, "smile1"), all = table(video, "smile1");
    ASSERT_EQ(one.rows(), 1);
    const auto same = [&](const char* column) {
        EXPECT_EQ(
            one.cells[0][static_cast<std::size_t>(one.column(column))],
            all.cells[static_cast<std::size_t>(apex)][static_cast<std::size_t>(all.column(column))])
            << column;
    };
    for (const char* column : {"source_frame", "ch_l.u_px", "ch_l.y_mm",
                               "activation.zygomaticus_major.l", "luminance_mean"})
        same(column);
    EXPECT_EQ(one.number(0, one.column("duration")), 0.4);
    const double seen_mm = still.at("motion").at("seen_mm").get<double>();
    EXPECT_GE(seen_mm, 0.99 * film.at("motion").at("seen_mm").get<double>() - 1e-3);
    EXPECT_LE(seen_mm, film.at("motion").at("seen_mm").get<double>() + 1e-3);
    EXPECT_NEAR(still.at("motion").at("full_mm").get<double>(),
                film.at("motion").at("full_mm").get<double>(), 1e-9);
    EXPECT_TRUE(still.at("movement_onset_frame").is_null());
    EXPECT_EQ(still.at("duration_s"), 0.4);

    // Controls change the picture; the neutral one shows the first frame
    const Image mirrored = picture(set, "smile1Mirrored");
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 48; ++x) ASSERT_EQ(mirrored.pixel(x, y)[1], shown.pixel(47 - x, y)[1]);
    EXPECT_NE(picture(set, "smile1LowPass3").rgba, shown.rgba);
    EXPECT_EQ(table(set, "smile1Neutral").number(0, 3), 0) << "source_frame";
    EXPECT_TRUE(sidecar(set, "smile1Neutral_image").at("motion").at("seen_mm").is_null());

    // The files of the set speak of pictures
    const animate::FrameRows list = animate::frame_rows(text_of(set.out / "stimuli/stimuli.tsv"));
    EXPECT_EQ(list.cells[0][static_cast<std::size_t>(list.column("type"))], "image");
    EXPECT_EQ(list.cells[0][static_cast<std::size_t>(list.column("filename"))],
              "stim-smile1_image.png");
    EXPECT_NE(list.cells[0][static_cast<std::size_t>(list.column("HED"))].find("(Image, "),
              std::string::npos);
    const std::string triggers = text_of(set.out / "triggers.tsv");
    EXPECT_NE(triggers.find("smile1\tclip_on\t1\t0\t0\tn/a\nsmile1\tclip_off\t4\t1\t0.4\tn/a\n"),
              std::string::npos)
        << triggers;
    const std::string methods = text_of(set.out / "methods.md");
    EXPECT_NE(methods.find("4 pictures (1 condition, 3 controls)"), std::string::npos) << methods;
    EXPECT_NE(methods.find("at the apex of a simulated movement. An experiment shows each for "
                           "0.4 s."),
              std::string::npos)
        << methods;
    // A second run finds everything made
    EXPECT_EQ(make_batch(set).kept, 4);
}

TEST_F(Pictures, ShowAGivenTimeAndMatchLuminance) {
    Json json = pictures(R"(["upside_down"])",
                         R"({"quality": "preview", "ending": "png", "still_s": 0.21})");
    json["sets"][0]["factors"]["intensity"] = {0.5, 1};
    json["match"] = Json::parse(
        R"({"luminance": {"within": "face", "mean": 0.2, "sd": 0.09, "one_for": "clip"}})");
    json["experiment"] = Json::parse(R"({"programs": ["psychopy", "jspsych"],
        "answers": {"a": "1", "l": "0.5"}, "correct": "intensity"})");
    const BatchOptions set = options_of(json, "matched");
    EXPECT_EQ(make_batch(set).made, 4);
    for (const char* clip : {"smile1", "smile0p5", "smile1UpsideDown"}) {
        EXPECT_EQ(table(set, clip).number(0, 3), 2) << clip << ": source_frame";
        const Json after = sidecar(set, std::string(clip) + "_image").at("luminance").at("after");
        EXPECT_NEAR(after.at("sum").get<double>() / after.at("weight").get<double>(), 0.2, 2e-3)
            << clip;
    }
    // Half of the intensity is seen as less
    const auto seen_mm = [&](const char* clip) {
        return sidecar(set, std::string(clip) + "_image").at("motion").at("seen_mm").get<double>();
    };
    EXPECT_LT(seen_mm("smile0p5"), 0.9 * seen_mm("smile1"));
    EXPECT_FALSE(fs::exists(set.out / "intermediate"));
    const std::string conditions = text_of(set.out / "experiment/conditions.csv");
    EXPECT_EQ(conditions.substr(0, conditions.find('\n')),
              "stim_id,stim_file,set,control,frames,fps,audio_file,correct_key,shown_s,"
              "value_intensity");
    EXPECT_NE(conditions.find("smile1,stim-smile1_image.png,smiles,,1,10,,a,1,1"),
              std::string::npos)
        << conditions;
}

TEST_F(Pictures, RefuseWhatAPictureCannotShow) {
    const auto complaint = [&](const Json& json) {
        return message_of([&] { make_batch(options_of(json, "refused")); });
    };
    EXPECT_NE(complaint(pictures(R"(["reversed"])", kPng))
                  .find("expected a control that a picture can show, found reversed"),
              std::string::npos);
    EXPECT_NE(complaint(pictures("[]", R"({"ending": "png", "crf": 20})"))
                  .find("/clips/crf: expected none beside \"ending\": \"png\", which makes "
                        "pictures, found 20"),
              std::string::npos);
    EXPECT_NE(complaint(pictures("[]", R"({"ending": "mp4", "still_s": 1})"))
                  .find("/clips/still_s: expected none without \"ending\": \"png\", found 1"),
              std::string::npos);
    EXPECT_NE(complaint(pictures("[]", R"({"ending": "png", "still_s": 0.6})"))
                  .find("expected a script that lasts until clips/still_s, found 0.5 s"),
              std::string::npos);
    Json sounding = pictures("[]", R"({"ending": "png"})");
    sounding["sets"][0]["audio"] = "word.wav";
    EXPECT_NE(complaint(sounding).find("expected no audio in a set of pictures, found"),
              std::string::npos);
    Json moving = pictures("[]", R"({"ending": "png", "still_s": 0.2})");
    moving["match"] = Json::parse(R"({"motion": {"share": [0.5], "of": "intensity"}})");
    EXPECT_NE(complaint(moving).find("/clips/still_s: expected none beside a match of motion"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(folder().path() / "refused"));
}

// A movement along a line: the apex is the first frame with 99 % of it.
TEST_F(Pictures, ChooseTheFirstFrameAtTheApex) {
    animate::LandmarkFrames frames;
    frames.ids = {"v", "op", "eu_l", "ch_l"};
    for (const double way_mm : {0.0, 2.0, 9.95, 10.0, 3.0}) {
        Points points(4, 3);
        points << 0, 100, 0, 0, 0, -90, 70, 50, 0, 25, -40 + way_mm, 90;
        frames.positions_mm.push_back(points);
    }
    const SeenPicture apex = seen_picture(frames, {}, {});
    EXPECT_EQ(apex.frame, 2);
    EXPECT_NEAR(apex.seen_mm, 9.95, 1e-9);
    EXPECT_EQ(apex.landmark, "ch_l");
    EXPECT_NEAR(seen_picture(frames, {}, 1).seen_mm, 2, 1e-9);
    // What the twin does too is not the expression
    EXPECT_EQ(seen_picture(frames, frames, {}).frame, 0);
    EXPECT_EQ(seen_picture(frames, frames, {}).landmark, "");
}

}  // namespace
}  // namespace risorius::stimuli
