// SPDX-License-Identifier: MIT
// Histograms and amplitude spectra are alike over heads and views, measured on the clips as they are shown.
#include "risorius/stimuli/detail/luminance_maps.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "paths.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/media/luminance.h"
#include "risorius/media/video_reader.h"
#include "risorius/media/video_writer.h"
#include "risorius/scene/face_oval.h"
#include "risorius/stimuli/detail/luminance_match.h"
#include "risorius/stimuli/detail/unmatched_render.h"
#include "temporary_folder.h"

namespace risorius::stimuli {
namespace {

namespace fs = std::filesystem;

constexpr int kSize_px = 96;

std::string text_in_set(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The luminance of decoded frames of a clip with the weights of the soft oval; what shows the background has none.
std::vector<media::LuminancePlane> shown_planes(const fs::path& set, const std::string& clip) {
    media::VideoReader video(set / ("stimuli/stim-" + clip + "_video.mkv"));
    const animate::FrameRows rows = animate::frame_rows(
        text_in_set(set / ("stimuli/stim-" + clip + "_annot-frames_events.tsv")));
    std::vector<media::LuminancePlane> out;
    for (int n = 0; n < video.frames(); ++n) {
        const Image frame = video.frame(n);
        std::vector<Vec2> border;
        for (const std::string& id : scene::FaceOval::landmarks())
            if (const int u = rows.column(id + ".u_px"); u >= 0)
                border.emplace_back(rows.number(n, u), rows.number(n, u + 1));
        std::vector<float> weights =
            scene::FaceOval(border).soft_pixels(frame.width_px, frame.height_px, 0.08);
        for (std::size_t i = 0; i < weights.size(); ++i)
            if (std::abs(frame.rgba[4 * i] - 128) + std::abs(frame.rgba[4 * i + 2] - 128) < 4)
                weights[i] = 0;
        out.push_back(media::luminance_plane(frame, weights));
    }
    return out;
}

/// Amplitudes by whole cycles per picture, for an area of 1, by the sum that defines them.
std::vector<double> ring_amplitudes(const std::vector<media::LuminancePlane>& planes, double mean) {
    using Complex = std::complex<double>;
    constexpr int n = kSize_px;
    std::vector<double> sum(n, 0);
    double area = 0;
    std::vector<Complex> waves;
    for (int k = 0; k < n; ++k) waves.push_back(std::polar(1.0, -2 * M_PI * k / n));
    for (const media::LuminancePlane& plane : planes) {
        std::vector<Complex> rows(n * n), all(n * n);
        const auto wave = [&](int k, int x) { return waves[static_cast<std::size_t>(k * x % n)]; };
        for (int y = 0; y < n; ++y)
            for (int k = 0; k < n; ++k)
                for (int x = 0; x < n; ++x) {
                    const auto at = static_cast<std::size_t>(y * n + x);
                    rows[static_cast<std::size_t>(y * n + k)] +=
                        (static_cast<double>(plane.y[at]) - mean) *
                        static_cast<double>(plane.weights[at]) * wave(k, x);
                }
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int y = 0; y < n; ++y)
                    all[static_cast<std::size_t>(j * n + k)] +=
                        rows[static_cast<std::size_t>(y * n + k)] * wave(j, y);
        std::vector<double> energy(n, 0), in_ring(n, 0);
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const auto r = static_cast<std::size_t>(
                    std::lround(std::hypot(std::min(j, n - j), std::min(k, n - k))));
                energy[r] += std::norm(all[static_cast<std::size_t>(j * n + k)]);
                ++in_ring[r];
            }
        for (std::size_t r = 0; r < sum.size(); ++r)
            if (in_ring[r] > 0) sum[r] += energy[r] / in_ring[r];
        for (const float w : plane.weights) area += static_cast<double>(w) * static_cast<double>(w);
    }
    for (double& one : sum) one = std::sqrt(one / area);
    return sum;
}

std::vector<double> quantiles_of(const std::vector<media::LuminancePlane>& planes) {
    media::LuminanceDistribution distribution;
    for (const media::LuminancePlane& plane : planes) distribution.add(plane);
    return distribution.quantiles();
}

class LuminanceMaps : public testing::Test {
  protected:
    fs::path design(const Json& luminance, const Json& controls = Json::array()) const {
        Json json = Json::parse(R"({"format": "risorius-design", "version": 1, "name": "maps",
            "clips": {"quality": "draft", "ending": "mkv"},
            "sets": [{"name": "maps", "clip": "${camera}_${expression}",
                "factors": {"camera": ["front", "three_quarter"], "expression": ["happiness", "fear"]},
                "script": {"format": "risorius-script", "version": 1, "fps": 5, "duration_s": 0.6,
                    "events": [{"expression": "${expression}", "start_s": 0, "onset_s": 0.3,
                                "hold_s": 0.3}],
                    "view": {"camera": "${camera}"}}}]})");
        json["sets"][0]["script"]["rig"] = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";
        json["sets"][0]["script"]["view"]["width_px"] = kSize_px;
        json["sets"][0]["script"]["view"]["height_px"] = kSize_px;
        json["sets"][0]["controls"] = controls;
        json["match"]["luminance"] = luminance;
        std::ofstream(folder_.path() / "design.json") << json.dump();
        return folder_.path() / "design.json";
    }
    BatchOptions options(const fs::path& file, const char* out) const {
        return {.design = file, .out = folder_.path() / out, .workers = 2};
    }

  private:
    TemporaryFolder folder_;
};

TEST_F(LuminanceMaps, HeadsAndViewsHaveOneHistogramAndOneSpectrum) {
    const fs::path file = design({{"within", "face"},
                                  {"mean", 0.25},
                                  {"sd", 0.1},
                                  {"histogram", true},
                                  {"spectrum", "rotational"}},
                                 {"reversed"});
    const BatchOptions whole = options(file, "set");
    EXPECT_EQ(make_batch(whole).made, 8);
    EXPECT_FALSE(fs::exists(whole.out / "intermediate"));
    std::array<std::vector<media::LuminancePlane>, 2> shown;
    for (std::size_t view = 0; view < 2; ++view)
        for (const char* expression : {"Happiness", "Fear"})
            for (media::LuminancePlane& plane : shown_planes(
                     whole.out, (view == 0 ? "front" : "threeQuarter") + std::string(expression)))
                shown[view].push_back(std::move(plane));
    std::array<std::vector<double>, 2> quantiles, amplitudes;
    for (std::size_t view = 0; view < 2; ++view) {
        quantiles[view] = quantiles_of(shown[view]);
        EXPECT_NEAR(media::mean_of_quantiles(quantiles[view]), 0.25, 0.003);
        EXPECT_NEAR(media::sd_of_quantiles(quantiles[view]), 0.1, 0.003);
        amplitudes[view] = ring_amplitudes(shown[view], 0.25);
    }
    double apart = 0;
    for (std::size_t i = 0; i < quantiles[0].size(); ++i)
        apart += std::pow(quantiles[0][i] - quantiles[1][i], 2);
    EXPECT_LT(std::sqrt(apart / static_cast<double>(quantiles[0].size())) / 0.1, 0.02)
        << "what rounding to bytes leaves";
    double squares = 0, worst = 0, before = 0;
    for (std::size_t r = 2; r < 30; ++r) {
        const double error = amplitudes[0][r] / amplitudes[1][r] - 1;
        squares += error * error;
        worst = std::max(worst, std::abs(error));
    }
    EXPECT_LT(std::sqrt(squares / 28), 0.03);
    EXPECT_LT(worst, 0.08);

    // The report, before and after
    const animate::FrameRows table =
        animate::frame_rows(text_in_set(whole.out / "luminance/spectrum.tsv"));
    int octaves = 0;
    double after = 0;
    for (int row = 0; row < table.rows(); ++row) {
        if (table.cells[static_cast<std::size_t>(row)][0] != "frontFear" ||
            table.number(row, 1) > 8)
            continue;
        ++octaves;
        before += std::abs(table.number(row, 3) / table.number(row, 5) - 1);
        after += std::abs(table.number(row, 4) / table.number(row, 5) - 1);
    }
    EXPECT_GE(octaves, 3);
    EXPECT_LT(after, 0.5 * before);
    const animate::FrameRows luminance =
        animate::frame_rows(text_in_set(whole.out / "luminance/luminance.tsv"));
    ASSERT_GE(luminance.column("histogram_error"), 0);
    EXPECT_EQ(luminance.cells[0][static_cast<std::size_t>(luminance.column("gain"))], "n/a");

    // Kept while nothing changes; made again from anew when a clip is gone; the same in parts
    EXPECT_EQ(make_batch(whole).kept, 8);
    const std::string sums = text_in_set(whole.out / "SHA256SUMS");
    fs::remove(whole.out / "stimuli/stim-frontFear_video.json");
    BatchOptions again = whole;
    again.replace = true;
    EXPECT_EQ(make_batch(again).made, 1);
    EXPECT_EQ(text_in_set(whole.out / "SHA256SUMS"), sums);
    BatchOptions parts = options(file, "parts");
    parts.parts = parts.part = 2;
    EXPECT_EQ(make_batch(parts).unmeasured, 2);
    parts.parts = parts.part = 1;
    EXPECT_TRUE(make_batch(parts).complete);
    EXPECT_EQ(text_in_set(parts.out / "SHA256SUMS"), sums);
}

/// How far groups are from what their maps aim at: RMS of the histogram / its deviation, and of the amplitudes, relative, with the worst.
struct Misses {
    double histogram = 0, amplitude = 0, worst = 0;
};
Misses misses_of(const std::vector<media::LuminancePlane>& planes, const MappedLuminance& mapped) {
    Misses out;
    const std::vector<double> found = quantiles_of(planes);
    for (std::size_t i = 0; i < found.size(); ++i)
        out.histogram += std::pow(found[i] - mapped.target[i], 2);
    out.histogram = std::sqrt(out.histogram / static_cast<double>(found.size())) /
                    media::sd_of_quantiles(mapped.target);
    media::RingAmplitudes rings;
    for (const media::LuminancePlane& plane : planes)
        rings.add(plane, media::mean_of_quantiles(mapped.target));
    const std::vector<double> amplitudes = rings.amplitudes();
    const int finest = planes.front().width_px / 3;
    for (int r = 2; r <= finest; ++r) {
        const auto at = static_cast<std::size_t>(r);
        const double error = amplitudes[at] / mapped.amplitudes[at] - 1;
        out.amplitude += error * error / (finest - 1);
        out.worst = std::max(out.worst, std::abs(error));
    }
    out.amplitude = std::sqrt(out.amplitude);
    return out;
}

/// The pictures as a player shows them: coded into a video and decoded, with the weights that they have.
std::vector<media::LuminancePlane> decoded(const std::vector<Image>& pictures,
                                           const std::vector<media::LuminancePlane>& weighted,
                                           media::VideoOptions options, const fs::path& file) {
    options.width_px = pictures.front().width_px;
    options.height_px = pictures.front().height_px;
    media::VideoWriter writer(file, options);
    for (const Image& picture : pictures) writer.append(picture);
    writer.finish();
    media::VideoReader reader(file);
    std::vector<media::LuminancePlane> out;
    for (int n = 0; n < reader.frames(); ++n)
        out.push_back(
            media::luminance_plane(reader.frame(n), weighted[static_cast<std::size_t>(n)].weights));
    return out;
}

/// The larger one of each.
Misses worse(const Misses& a, const Misses& b) {
    return {std::max(a.histogram, b.histogram), std::max(a.amplitude, b.amplitude),
            std::max(a.worst, b.worst)};
}

// Nothing is rounded until a picture is shown, and then luminance is rounded last.
TEST_F(LuminanceMaps, ReachTheirTargetsUntilTheLastRounding) {
    Json json = Json::parse(text_in_set(design({{"within", "face"},
                                                {"mean", 0.25},
                                                {"sd", 0.1},
                                                {"histogram", true},
                                                {"spectrum", "rotational"}})));
    json["sets"][0]["script"]["view"]["width_px"] = 192;
    json["sets"][0]["script"]["view"]["height_px"] = 192;
    const fs::path file = design({{"mean", 0.3}});
    std::ofstream(file) << json.dump();
    const fs::path deep = options(file, "deep").out;
    BatchPlan plan = plan_batch(file);
    {
        animate::RenderSession session;
        SettledMotions settled;
        const ProgressMonitor quiet;
        for (const std::size_t i : unmeasured(plan, deep))
            make_unmatched_render(plan.clips[i], {.folder = deep,
                                                  .threads = 1,
                                                  .clips_at_once = 1,
                                                  .inputs = *plan.inputs,
                                                  .session = session,
                                                  .settled = settled,
                                                  .monitor = quiet});
    }
    fit_maps(deep, plan);
    struct Group {
        std::vector<media::LuminancePlane> exact, shown;
        std::vector<Image> pictures;
    };
    std::map<std::string, Group> groups;
    for (const ClipPlan& clip : plan.clips) {
        const auto render = find_unmatched_render(clip, deep);
        ASSERT_TRUE(render.has_value());
        const animate::FrameRows rows = animate::frame_rows(render->table);
        media::VideoReader video(render->video);
        for (int n = 0; n < video.frames(); ++n) {
            Image picture = video.frame(n);
            ASSERT_FALSE(picture.deep.empty());
            const std::vector<float> weights = measured_weights(clip, rows, n, picture);
            media::LuminancePlane plane = media::luminance_plane(picture, weights);
            clip.mapped->map.apply(plane);
            media::set_luminance(plane.y, false, picture);
            media::ToneCurve(media::Tone{}).apply_over({128, 128, 128}, picture);
            Group& group = groups[clip.scene_sha256];
            group.exact.push_back(std::move(plane));
            group.shown.push_back(media::luminance_plane(picture, weights));
            group.pictures.push_back(std::move(picture));
        }
    }
    ASSERT_EQ(groups.size(), 2u);
    const MappedLuminance& mapped = *plan.clips.front().mapped;
    std::map<std::string, Misses> misses;
    for (const auto& [name, group] : groups) {
        const auto look = [&](const char* as, const std::vector<media::LuminancePlane>& planes) {
            misses[as] = worse(misses[as], misses_of(planes, mapped));
        };
        look("exact", group.exact);
        look("shown", group.shown);
        for (const auto& [as, target, coding] :
             {std::tuple{"mkv", "a.mkv", media::VideoOptions{}},
              std::tuple{"lossless", "a.mp4", media::VideoOptions{.lossless = true}},
              std::tuple{"mp4", "b.mp4", media::VideoOptions{}},
              std::tuple{"crf14", "d.mp4", media::VideoOptions{.crf = 14}},
              std::tuple{"crf4", "c.mp4", media::VideoOptions{.crf = 4}}})
            look(as, decoded(group.pictures, group.shown, coding, deep / target));
    }
    for (const auto& [name, of] : misses)
        RecordProperty("misses_of_" + name, std::to_string(of.histogram) + " " +
                                                std::to_string(of.amplitude) + " " +
                                                std::to_string(of.worst));
    for (const char* name : {"exact", "shown", "mkv", "lossless"}) {
        EXPECT_LT(misses[name].histogram, 0.001) << name;
        EXPECT_LT(misses[name].amplitude, 0.012) << name;
        EXPECT_LT(misses[name].worst, 0.02) << name;
    }
}

TEST_F(LuminanceMaps, GreyFacesHaveNoColourAndTheSameBackground) {
    const BatchOptions whole =
        options(design({{"within", "face"}, {"histogram", true}, {"colour", "grey"}}), "grey");
    EXPECT_EQ(make_batch(whole).made, 4);
    const Image frame = media::VideoReader(whole.out / "stimuli/stim-frontFear_video.mkv").frame(1);
    for (int y = 0; y < kSize_px; ++y)
        for (int x = 0; x < kSize_px; ++x) {
            const std::uint8_t* pixel = frame.pixel(x, y);
            ASSERT_EQ(pixel[0], pixel[1]);
            ASSERT_EQ(pixel[0], pixel[2]);
        }
    EXPECT_EQ(frame.pixel(1, 1)[0], 128);
}

TEST_F(LuminanceMaps, TargetsThatCannotBeHadAreRefused) {
    const fs::path file =
        design({{"within", "face"}, {"mean", 0.5}, {"sd", 0.45}, {"histogram", true}});
    EXPECT_NE(message_of([&] {
                  make_batch(options(file, "none"));
              }).find("a mean and an sd that the histogram can have without more than 0.5 %"),
              std::string::npos);
    EXPECT_NE(message_of([&] {
                  plan_batch(design({{"within", "face"}, {"histogram", true}, {"rounds", 3}}));
              }).find("rounds: expected \"spectrum\" beside it"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::stimuli
