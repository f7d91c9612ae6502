// SPDX-License-Identifier: MIT
// Chimeric clips: which half shows which condition, where the seam is, and the tables of both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/media/image_file.h"
#include "risorius/media/video_reader.h"
#include "risorius/stimuli/batch.h"
#include "stimuli/batch_fixture.h"

namespace risorius::stimuli {
namespace {

class Chimeric : public Batch {
  protected:
    static Json two_faces(const std::string& controls) {
        Json json = Json::parse(text_of(design("chimeric.json", {1}, controls)));
        json["clips"] = Json::parse(R"({"quality": "draft", "ending": "mkv"})");
        Json& set = json["sets"][0];
        set["clip"] = "${expression}";
        set["factors"] = Json::parse(R"({"expression": ["happiness", "surprise"]})");
        set["script"]["events"][0]["expression"] = "${expression}";
        set["script"]["events"][0]["intensity"] = 1;
        return json;
    }
    static BatchOptions options_of(const Json& json, const std::string& name) {
        const fs::path file = folder().path() / (name + ".json");
        std::ofstream(file) << json.dump();
        return {.design = file, .out = folder().path() / name, .workers = 1};
    }
    static Image frame(const BatchOptions& set, const std::string& clip) {
        return media::VideoReader(set.out / ("stimuli/stim-" + clip + "_video.mkv")).frame(4);
    }
    static animate::FrameRows table(const BatchOptions& set, const std::string& clip) {
        return animate::frame_rows(
            text_of(set.out / ("stimuli/stim-" + clip + "_annot-frames_events.tsv")));
    }
    static constexpr const char* kSurprised =
        R"([{"control": "chimeric", "lower": {"expression": "surprise"},
             "when": {"expression": "happiness"}},
            {"control": "chimeric", "lower": {"expression": "surprise"}, "offset": 0.3,
             "when": {"expression": "happiness"}}])";
};

/// A cell of stimuli.tsv as a number.
double listed(const BatchOptions& set, const std::string& clip, const char* column) {
    const animate::FrameRows rows = animate::frame_rows(text_of(set.out / "stimuli/stimuli.tsv"));
    for (int r = 0; r < rows.rows(); ++r)
        if (rows.cells[static_cast<std::size_t>(r)][0] == "stim-" + clip)
            return rows.number(r, rows.column(column));
    return NAN;
}

// Of surprise the jaw goes farthest, which the lower half shows; of happiness the corners of the mouth, which the upper half lacks.
void expect_halves(const BatchOptions& set, const std::string& clip) {
    EXPECT_NEAR(listed(set, clip, "seen_lower_mm"), listed(set, "surprise", "seen_mm"), 1e-3);
    EXPECT_NEAR(listed(set, clip, "seen_lower_share"), listed(set, "surprise", "seen_share"), 1e-4);
    EXPECT_LT(listed(set, clip, "seen_upper_mm"), 0.7 * listed(set, "happiness", "seen_mm"));
    EXPECT_GT(listed(set, clip, "seen_upper_mm"), 0.5);
    EXPECT_GT(listed(set, clip, "seen_upper_share"), 0.6);
    EXPECT_LT(listed(set, clip, "seen_upper_share"), 1.1);
    EXPECT_EQ(listed(set, clip, "seen_mm"),
              std::max(listed(set, clip, "seen_lower_mm"), listed(set, clip, "seen_upper_mm")));
}

TEST_F(Chimeric, ShowsTwoConditionsAboveAndBelowTheSeam) {
    const BatchOptions set = options_of(two_faces(kSurprised), "halves");
    const BatchReport report = make_batch(set);
    ASSERT_EQ(report.made, 4) << (report.failed.empty() ? "" : report.failed[0].second);
    const std::string name = "happinessChimericSurprise";
    const Image chimera = frame(set, name), upper = frame(set, "happiness"),
                lower = frame(set, "surprise");
    const Json sidecar = Json::parse(text_of(set.out / ("stimuli/stim-" + name + "_video.json")));
    const double row = sidecar.at("seam").at("row_px").get<double>(),
                 height = sidecar.at("seam").at("height_px").get<double>();
    const animate::FrameRows rows = table(set, name), happy = table(set, "happiness"),
                             surprised = table(set, "surprise");
    const auto cell = [](const animate::FrameRows& of, const char* column) {
        return of.cells[4][static_cast<std::size_t>(of.column(column))];
    };
    EXPECT_GT(row, happy.number(0, happy.column("n.v_px")));
    EXPECT_LT(row, happy.number(0, happy.column("sn.v_px")));
    int differ_above = 0, differ_below = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 48; ++x) {
            const std::uint8_t *a = chimera.pixel(x, y), *b = upper.pixel(x, y),
                               *c = lower.pixel(x, y);
            if (y + 1 < row - height) {
                ASSERT_TRUE(std::equal(a, a + 3, b)) << x << " " << y;
                differ_above += !std::equal(b, b + 3, c);
            } else if (y > row + height) {
                ASSERT_TRUE(std::equal(a, a + 3, c)) << x << " " << y;
                differ_below += !std::equal(b, b + 3, c);
            }
        }
    EXPECT_GT(differ_above, 20) << "brows";
    EXPECT_GT(differ_below, 50) << "mouth";

    // Landmarks are those of what is seen; both scripts are there
    for (const char* column : {"en_l.v_px", "ps_l.y_mm"})
        EXPECT_EQ(cell(rows, column), cell(happy, column)) << column;
    for (const char* column : {"ch_l.u_px", "sto.y_mm", "gn.v_px"}) {
        EXPECT_EQ(cell(rows, column), cell(surprised, column)) << column;
        EXPECT_NE(cell(rows, column), cell(happy, column)) << column;
    }
    const Json script = Json::parse(text_of(set.out / ("code/scripts/" + name + "_lower.json")));
    EXPECT_EQ(script.at("events").at(0).at("expression"), "surprise");
    EXPECT_EQ(Json::parse(text_of(set.out / ("code/scripts/" + name + ".json")))
                  .at("events")
                  .at(0)
                  .at("expression"),
              "happiness");
    EXPECT_GT(sidecar.at("seam").at("difference_mean").get<double>(), 0);
    EXPECT_LE(sidecar.at("seam").at("difference_mean").get<double>(),
              sidecar.at("seam").at("difference_max").get<double>());
    EXPECT_TRUE(sidecar.at("motion").at("full_mm").is_null());

    // The lower half to the right, with background beside it
    const std::string moved = "happinessChimericSurpriseOffset0p3";
    const Json aside = Json::parse(text_of(set.out / ("stimuli/stim-" + moved + "_video.json")));
    const int offset = aside.at("seam").at("offset_px").get<int>();
    EXPECT_GT(offset, 3);
    const Image shifted = frame(set, moved);
    const int bottom = static_cast<int>(row + height) + 4;
    for (int x = 0; x < 48; ++x) {
        const std::uint8_t* a = shifted.pixel(x, bottom);
        if (x < offset)
            EXPECT_EQ(a[0], 128) << x;
        else
            EXPECT_TRUE(std::equal(a, a + 3, lower.pixel(x - offset, bottom))) << x;
    }
    EXPECT_NEAR(table(set, moved).number(4, rows.column("ch_l.u_px")),
                surprised.number(4, surprised.column("ch_l.u_px")) + offset, 1e-3);
    const std::string list = text_of(set.out / "stimuli/stimuli.tsv");
    EXPECT_NE(list.find("\tseam_row_px\tseam_difference\t"), std::string::npos);
    expect_halves(set, name);
    expect_halves(set, moved);
    const Json upper_half = sidecar.at("motion").at("upper");
    EXPECT_EQ(upper_half.at("seen_landmark").get<std::string>().find("ch_"), std::string::npos);
    EXPECT_GT(upper_half.at("seen_onset_frame"), 0);
    EXPECT_EQ(make_batch(set).kept, 4);
}

TEST_F(Chimeric, GoesWithPicturesAndMatchedLuminance) {
    Json json = two_faces(kSurprised);
    json["clips"] = Json::parse(R"({"quality": "draft", "ending": "png"})");
    json["match"] = Json::parse(
        R"({"luminance": {"within": "face", "mean": 0.2, "sd": 0.08, "one_for": "all"}})");
    const BatchOptions set = options_of(json, "matched");
    const BatchReport report = make_batch(set);
    ASSERT_EQ(report.made, 4) << (report.failed.empty() ? "" : report.failed[0].second);
    const auto picture = [&](const std::string& clip) {
        return media::read_png(set.out / ("stimuli/stim-" + clip + "_image.png"));
    };
    const Image chimera = picture("happinessChimericSurprise"), upper = picture("happiness"),
                lower = picture("surprise");
    // One map for all, so that each half is the same as in its own picture
    for (int x = 0; x < 48; ++x)
        for (const int y : {4, 20, 50, 60}) {
            const std::uint8_t *a = chimera.pixel(x, y), *b = (y < 30 ? upper : lower).pixel(x, y);
            for (int k = 0; k < 3; ++k) ASSERT_NEAR(a[k], b[k], 1) << x << " " << y;
        }
    expect_halves(set, "happinessChimericSurprise");
}

TEST_F(Chimeric, HasNoMotionInAHalfThatStandsStill) {
    Json json = two_faces(R"([{"control": "chimeric", "lower": {"strength": 0},
                               "when": {"expression": "surprise"}}])");
    json["sets"][0]["parameters"]["strength"] = 1;
    json["sets"][0]["script"]["events"][0]["intensity"] = "${strength}";
    const BatchOptions set = options_of(json, "still");
    ASSERT_EQ(make_batch(set).made, 3);
    const std::string clip = "surpriseChimeric0";
    EXPECT_EQ(listed(set, clip, "seen_lower_mm"), 0);
    EXPECT_GT(listed(set, clip, "seen_upper_mm"), 1);
    const std::string record = text_of(set.out / ("stimuli/stim-" + clip + "_video.json"));
    EXPECT_TRUE(Json::parse(record).at("motion").at("lower").at("full_mm").is_null())
        << "a face at rest has no share";
}

TEST_F(Chimeric, RefusesHalvesThatDoNotFit) {
    const auto complaint = [&](Json json) {
        return message_of([&] { plan_batch(options_of(json, "refused").design); });
    };
    EXPECT_NE(complaint(two_faces(R"(["chimeric"])"))
                  .find("expected an object with \"control\" and \"lower\", found"),
              std::string::npos);
    EXPECT_NE(complaint(two_faces(R"([{"control": "chimeric", "lower": {}}])"))
                  .find("/lower: expected at least one parameter of the lower half, found none"),
              std::string::npos);
    EXPECT_NE(complaint(two_faces(R"([{"control": "chimeric", "lower": {"expresion": "anger"}}])"))
                  .find("\"expression\""),
              std::string::npos);
    Json longer = two_faces(R"([{"control": "chimeric", "lower": {"duration": 0.8}}])");
    longer["sets"][0]["parameters"]["duration"] = 0.5;
    longer["sets"][0]["script"]["duration_s"] = "${duration}";
    const std::string message = complaint(longer);
    EXPECT_NE(
        message.find("expected a lower half of 5 frames at 10 fps of 48 x 64, found 8 frames"),
        std::string::npos)
        << message;
}

}  // namespace
}  // namespace risorius::stimuli
