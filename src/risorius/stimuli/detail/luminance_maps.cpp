// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/luminance_maps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/animate/frame_rows.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/media/video_reader.h"
#include "risorius/stimuli/detail/unmatched_render.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;
using OneFor = design::LuminanceMatch::OneFor;

namespace {

constexpr double kPictures_bytes =
    600e6;  // luminance and weights of the pictures that a map is fitted to
constexpr double kNearTarget = 0.003;  // of a standard deviation
constexpr int kOctaves = 9;

/// The conditions whose pictures a group pools, in the order of the plan.
std::map<std::string, std::vector<const ClipPlan*>> groups_of(const BatchPlan& plan) {
    const OneFor one_for = plan.match.luminance->one_for;
    std::map<std::string, std::vector<const ClipPlan*>> out;
    for (const ClipPlan& clip : plan.clips) {
        std::vector<const ClipPlan*>& group = out[map_group(clip, one_for)];
        if (!clip.is_control()) group.push_back(&clip);
    }
    // A neutral face has the map of its head also when each condition has its own.
    if (one_for == OneFor::kClip)
        for (const ClipPlan& clip : plan.clips)
            if (const auto neutral = out.find(clip.scene_sha256);
                !clip.is_control() && neutral != out.end())
                neutral->second.push_back(&clip);
    return out;
}

/// The pictures of a group; of a large group every second one, or fewer.
std::vector<media::LuminancePlane> pictures_of(const std::vector<const ClipPlan*>& group,
                                               const fs::path& folder) {
    double bytes = 0;
    for (const ClipPlan* clip : group)
        bytes += 8.0 * clip->frames * clip->width_px * clip->height_px;
    const int step = std::max(1, static_cast<int>(std::ceil(bytes / kPictures_bytes)));
    std::vector<media::LuminancePlane> out;
    const ReadingFormerOutput own;
    int number = 0;
    for (const ClipPlan* clip : group) {
        const std::optional<UnmatchedRender> render = find_unmatched_render(*clip, folder);
        if (!render) throw RunError(clip->condition.clip + ": its unmatched render is missing");
        const animate::FrameRows rows = animate::frame_rows(render->table);
        media::VideoReader reader(render->video);
        for (int frame = 0; frame < reader.frames(); ++frame) {
            if (number++ % step != 0) continue;
            const Image picture = reader.frame(frame);
            out.push_back(
                media::luminance_plane(picture, measured_weights(*clip, rows, frame, picture)));
        }
    }
    return out;
}

/// T: the mean of the quantile functions of all groups, with the mean and deviation that are asked for.
std::vector<double> target_of(const BatchPlan& plan,
                              const std::vector<std::vector<double>>& quantiles) {
    const design::LuminanceMatch& match = *plan.match.luminance;
    std::vector<double> out(quantiles.front().size());
    for (const std::vector<double>& of : quantiles)
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] += of[i] / static_cast<double>(quantiles.size());
    const double mean = match.mean.value_or(media::mean_of_quantiles(out)),
                 sd = match.sd.value_or(media::sd_of_quantiles(out));
    std::vector<double> fitted = media::with_mean_and_sd(std::move(out), mean, sd);
    const double reached = media::sd_of_quantiles(fitted);
    const auto cut = static_cast<double>(std::count_if(fitted.begin(), fitted.end(),
                                                       [](double y) { return y <= 0 || y >= 1; })) /
                     static_cast<double>(fitted.size());
    if (!match.allow_clipping && (cut > match.cut_limit || std::abs(reached - sd) > kNearTarget ||
                                  std::abs(media::mean_of_quantiles(fitted) - mean) > kNearTarget))
        throw Error(plan.place("match/luminance"),
                    "a mean and an sd that the histogram can have without more than " +
                        format_number(100 * match.cut_limit) +
                        " % at black or white, or \"allow_clipping\": true",
                    format_number(std::round(1000 * cut) / 10) + " %");
    return fitted;
}

/// A*: the mean of the amplitudes of groups, with their mean energy.
std::vector<double> mean_amplitudes(const std::vector<std::vector<double>>& amplitudes,
                                    int width_px, int height_px) {
    std::size_t rings = 0;
    for (const std::vector<double>& of : amplitudes) rings = std::max(rings, of.size());
    std::vector<double> out(rings);
    double energy = 0;
    for (const std::vector<double>& of : amplitudes) {
        for (std::size_t r = 0; r < of.size(); ++r)
            out[r] += of[r] / static_cast<double>(amplitudes.size());
        energy += media::RingAmplitudes::energy(of, width_px, height_px) /
                  static_cast<double>(amplitudes.size());
    }
    const double now = media::RingAmplitudes::energy(out, width_px, height_px);
    for (double& one : out) one *= now > 0 ? std::sqrt(energy / now) : 1;
    return out;
}

/// Spectra can be compared in pictures of one size only.
void check_sizes(const BatchPlan& plan) {
    const ClipPlan& first = plan.clips.front();
    for (const ClipPlan& clip : plan.clips)
        if (clip.width_px != first.width_px || clip.height_px != first.height_px)
            throw Error(plan.place("match/luminance/spectrum"), "pictures of one size",
                        clip.condition.clip + " of another one than " + first.condition.clip);
}

double octave_edge(int octave) { return std::ldexp(1.0, octave); }

/// Amplitudes in octaves of cycles per face: root mean square over their rings; null where there are none.
Json octaves_of(const std::vector<double>& amplitudes, double faces_per_picture) {
    Json out = Json::array();
    for (int octave = 0; octave < kOctaves; ++octave) {
        double sum = 0, count = 0;
        for (std::size_t r = 1; r < amplitudes.size(); ++r) {
            const double cycles = static_cast<double>(r) / faces_per_picture;
            if (cycles < octave_edge(octave) || cycles >= octave_edge(octave + 1)) continue;
            sum += amplitudes[r] * amplitudes[r];
            ++count;
        }
        out.push_back(count > 0 ? Json(std::sqrt(sum / count)) : Json());
    }
    return out;
}

}  // namespace

std::string map_group(const ClipPlan& clip, OneFor one_for) {
    if (one_for == OneFor::kAll) return "";
    const bool neutral = clip.condition.control.kind == design::ControlKind::kNeutral;
    return one_for == OneFor::kIdentity || neutral ? clip.scene_sha256
                                                   : "clip " + clip.condition.of;
}

void name_maps(BatchPlan& plan) {
    if (!plan.match.luminance || !plan.match.luminance->has_maps()) return;
    const design::LuminanceMatch& match = *plan.match.luminance;
    if (match.spectrum) check_sizes(plan);
    Json renders = Json::array();
    for (const ClipPlan& clip : plan.clips)
        if (!clip.is_control()) renders.push_back(clip.render_sha256);
    const Json of = json_object({{"renders", renders},
                                 {"one_for", static_cast<int>(match.one_for)},
                                 {"mean", match.mean ? Json(*match.mean) : Json()},
                                 {"sd", match.sd ? Json(*match.sd) : Json()},
                                 {"spectrum", match.spectrum},
                                 {"rounds", match.rounds}});
    const std::string digest = animate::sha256_of_text(json_text(of));
    for (ClipPlan& clip : plan.clips)
        clip.content_sha256 = animate::sha256_of_text(
            json_text(json_object({{"content", clip.content_sha256}, {"maps", digest}})));
}

bool all_made(const BatchPlan& plan, const fs::path& folder) {
    return std::all_of(plan.clips.begin(), plan.clips.end(),
                       [&](const ClipPlan& clip) { return is_made(clip, folder); });
}

void fit_maps(const fs::path& folder, BatchPlan& plan) {
    const design::LuminanceMatch& match = *plan.match.luminance;
    const auto groups = groups_of(plan);
    std::vector<std::vector<double>> quantiles, amplitudes;
    int width_px = 0, height_px = 0;
    for (const auto& [name, group] : groups) {
        media::LuminanceDistribution distribution;
        for (const media::LuminancePlane& picture : pictures_of(group, folder))
            distribution.add(picture);
        quantiles.push_back(distribution.quantiles());
        for (const ClipPlan* clip : group) {
            width_px = clip->width_px;  // one for all, see check_sizes()
            height_px = clip->height_px;
        }
    }
    auto mapped = std::make_shared<MappedLuminance>();
    mapped->target = target_of(plan, quantiles);
    const double mean = media::mean_of_quantiles(mapped->target);
    if (match.spectrum) {
        for (const auto& [name, group] : groups) {
            std::vector<media::LuminancePlane> pictures = pictures_of(group, folder);
            const media::LuminanceMap first(pictures, mapped->target, {}, 0);
            media::RingAmplitudes rings;
            for (const media::LuminancePlane& picture : pictures) rings.add(picture, mean);
            amplitudes.push_back(rings.amplitudes());
        }
        mapped->amplitudes = mean_amplitudes(amplitudes, width_px, height_px);
    }
    std::map<std::string, std::shared_ptr<const MappedLuminance>> map_of;
    for (const auto& [name, group] : groups) {
        std::vector<media::LuminancePlane> pictures = pictures_of(group, folder);
        auto own = std::make_shared<MappedLuminance>(*mapped);
        own->map = media::LuminanceMap(pictures, mapped->target, mapped->amplitudes, match.rounds);
        map_of[name] = std::move(own);
    }
    for (ClipPlan& clip : plan.clips) clip.mapped = map_of.at(map_group(clip, match.one_for));
}

void MapReport::add_before(const media::LuminancePlane& plane) {
    width_px_ = plane.width_px;
    height_px_ = plane.height_px;
    if (!mapped_ || mapped_->amplitudes.empty()) return;
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < plane.y.size(); ++i) {
        sum += static_cast<double>(plane.weights[i]) * static_cast<double>(plane.y[i]);
        weight += static_cast<double>(plane.weights[i]);
    }
    before_.add(plane, weight > 0 ? sum / weight : 0);
}

void MapReport::add_shown(const media::LuminancePlane& plane) {
    if (!mapped_) return;
    shown_distribution_.add(plane);
    if (!mapped_->amplitudes.empty()) shown_.add(plane, media::mean_of_quantiles(mapped_->target));
}

Json MapReport::json() const {
    const std::vector<double> shown = shown_distribution_.quantiles();
    double squares = 0;
    for (std::size_t i = 0; i < shown.size(); ++i)
        squares += std::pow(shown[i] - mapped_->target[i], 2);
    Json out =
        json_object({{"histogram_error", std::sqrt(squares / static_cast<double>(shown.size())) /
                                             media::sd_of_quantiles(mapped_->target)}});
    if (mapped_->amplitudes.empty()) return out;
    const double faces = std::max(width_px_, height_px_) / face_px_;
    out["spectrum"] = json_object({{"before", octaves_of(before_.amplitudes(), faces)},
                                   {"after", octaves_of(shown_.amplitudes(), faces)},
                                   {"target", octaves_of(mapped_->amplitudes, faces)}});
    return out;
}

std::string spectrum_table(const std::vector<Json>& records) {
    std::string out = "stim_id\tcycles_per_face_from\tcycles_per_face_to\tbefore\tafter\ttarget\n";
    const auto cell = [](const Json& value) {
        char text[32];
        std::snprintf(text, sizeof text, "%.5g", value.get<double>());
        return std::string(text);
    };
    for (const Json& record : records) {
        const Json& spectrum = record.at("luminance").at("spectrum");
        for (int octave = 0; octave < kOctaves; ++octave) {
            const auto at = static_cast<std::size_t>(octave);
            if (spectrum.at("target").at(at).is_null()) continue;
            out += record.at("stim_id").get<std::string>() + "\t" +
                   format_number(octave_edge(octave)) + "\t" +
                   format_number(octave_edge(octave + 1));
            for (const char* key : {"before", "after", "target"})
                out += "\t" + cell(spectrum.at(key).at(at));
            out += "\n";
        }
    }
    return out;
}

}  // namespace risorius::stimuli
