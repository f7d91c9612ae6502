// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/coder_kit.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <utility>

#include "risorius/core/counter_rng.h"
#include "risorius/media/video_writer.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/report/atomic_file.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/track/timeline.h"

namespace risorius::inverse {

namespace {

constexpr int kSize_px = 384, kFps = 30, kNothing = 4;
constexpr double kPhase_s =
    0.5;  // onset, apex and offset each, and half of it at rest before and after

const char* const kReadme = R"(What to do

1. Watch each clip of the folder clips as often as you like. A face goes from neutral to something and back. Some faces do nothing.
2. Write the action units that you see into the column codes of sheet.tsv, joined by +, for instance 1+2 or 6+12+25. Put L or R before a
   number if only one side moves, and A to E behind it for the intensity if you can: 1C+2C, R12B. Write 0 for a face that does nothing.
3. Send the table back. Its owner compares it with the key:

   risorius evaluate RIG --facs --codes sheet.tsv --key key.tsv

Nobody but the owner should see the file key.tsv before.
)";

std::string clip_name(std::size_t at) {
    char name[32];
    std::snprintf(name, sizeof name, "clip_%03zu", at + 1);
    return name;
}

// The drive of a clip: up, held, down, as an expression of a script.
face::DriveAt drive_of(const KitClip& clip, const rig::RigDescription& rig,
                       const track::ChannelTable& channels) {
    track::ExpressionEvent course;
    course.start_s = kPhase_s / 2;
    course.onset_s = course.hold_s = course.offset_s = kPhase_s;
    struct Part {
        track::Expansion whole;
        track::UnitCurves curve;
    };
    std::vector<Part> parts;
    for (const std::string& id : clip.units) {
        const track::ActionUnit& unit = *rig.facs.find(id);
        parts.push_back({track::expand(unit, std::nullopt, channels), unit.curve});
    }
    return [=](double t_s) {
        track::Expansion sum = track::Expansion::none(channels);
        const double intensity = clip.intensity * track::expression_profile(course, 0, t_s);
        for (const Part& part : parts) sum.add(part.whole, part.curve, intensity);
        return rig::clamped_drive(sum, channels);
    };
}

}  // namespace

std::string KitClip::codes() const {
    if (units.empty()) return "0";
    std::string out;
    for (const std::string& unit : units)
        out += (out.empty() ? "" : "+") + unit.substr(2) + (intensity == 1 ? "E" : "C");
    return out;
}

std::vector<KitClip> kit_clips(const track::FacsTable& facs, const std::vector<std::string>& units,
                               std::uint64_t seed) {
    const auto asked = [&](const std::string& id) {
        return track::is_unit_number(id) &&
               std::find(units.begin(), units.end(), id) != units.end();
    };
    std::vector<KitClip> clips;
    for (const std::string& id : units)
        if (asked(id))
            for (const double intensity : {1.0, 0.5}) clips.push_back({{id}, intensity});
    for (const std::vector<std::string>& several : facs.combinations)
        if (std::all_of(several.begin(), several.end(), asked)) clips.push_back({several, 1});
    for (int i = 0; i < kNothing; ++i) clips.push_back({{}, 1});
    std::vector<std::size_t> order(clips.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto draw = [&](std::size_t i) { return CounterRng(seed).at(i).bits(); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return draw(a) < draw(b); });
    std::vector<KitClip> out;
    for (const std::size_t i : order) out.push_back(clips[i]);
    return out;
}

std::vector<std::string> write_coder_kit(face::Face& face, const rig::RigDescription& rig,
                                         const render::Scene& scene,
                                         const std::vector<KitClip>& clips,
                                         const std::filesystem::path& folder,
                                         const ProgressMonitor& monitor) {
    std::filesystem::create_directories(folder / "kit/clips");
    const track::ChannelTable channels = rig.channels();
    render::OffscreenView view(scene, {.width_px = kSize_px, .height_px = kSize_px});
    std::vector<std::string> files;
    std::string sheet = "clip\tcodes\tnote\n", key = "clip\tcodes\n";
    const int frames = static_cast<int>(4 * kPhase_s * kFps);
    for (std::size_t i = 0; i < clips.size(); ++i) {
        monitor.report(static_cast<double>(i) / static_cast<double>(clips.size()),
                       "clips of the kit");
        const std::string name = clip_name(i);
        files.push_back("kit/clips/" + name + ".mp4");
        media::VideoWriter video(folder / files.back(),
                                 {.width_px = kSize_px, .height_px = kSize_px, .fps = kFps});
        const face::DriveAt drive = drive_of(clips[i], rig, channels);
        face.start(drive);
        for (int f = 0; f < frames; ++f)
            video.append(view.draw(
                scene::pose_for_view(face.pose_at(static_cast<double>(f) / kFps, drive))));
        video.finish();
        sheet += name + "\t\t\n";
        key += name + "\t" + clips[i].codes() + "\n";
    }
    const auto write = [&](const std::string& file, const std::string& text) {
        report::write_text(folder / file, text);
        files.push_back(file);
    };
    write("kit/sheet.tsv", sheet);
    write("kit/README.txt", kReadme);
    write("key.tsv", key);
    return files;
}

}  // namespace risorius::inverse
