// SPDX-License-Identifier: MIT
#include "tools/risorius/studio_thumbnails.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/animate/render_inputs.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/result_cache.h"
#include "risorius/face/face.h"
#include "risorius/face/quality.h"
#include "risorius/face/surfaces.h"
#include "risorius/media/image_file.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"

namespace risorius::cli {

namespace fs = std::filesystem;

namespace {

constexpr int kMoments = 48;
constexpr std::size_t kMostThumbnails = 400;  // that wait: more is no list that a person reads

/// What is kept of a picture.
struct KeptPicture {
    std::vector<unsigned char> png;
};

/// The drive at the moment at which muscles are driven most.
track::Drive strongest_drive(const track::Timeline& timeline, double duration_s) {
    track::Drive best = timeline.at(0);
    for (int i = 1; i <= kMoments; ++i) {
        track::Drive drive = timeline.at(duration_s * i / kMoments);
        if (drive.excitation.sum() > best.excitation.sum()) best = std::move(drive);
    }
    return best;
}

Image drawn(const JsonCursor& script, const scene::RigFiles& files,
            const ProgressMonitor& monitor) {
    const track::ChannelTable channels = files.rig.channels();
    const track::ScriptDescription read =
        track::read_script(script, channels, files.rig.facs, files.rig.expressions);
    const track::Drive drive =
        strongest_drive(track::Timeline(read, channels), read.header.duration_s);
    monitor.throw_if_stopped();
    face::Face face(files.rig, files.mesh, face::quality_named("draft"), files.place());
    render::Scene scene = scene::scene_from_rig(face.head(), files.rig, files.mesh);
    scene::add_wrinkles(face.surfaces().wrinkle_lines(), scene);
    monitor.throw_if_stopped();
    render::OffscreenView view(scene, {.width_px = kThumbnail_px, .height_px = kThumbnail_px});
    monitor.throw_if_stopped();
    face.start([&](double) { return drive; });
    return view.draw(scene::pose_for_view(face.pose()));
}

}  // namespace

std::string thumbnail_of(const fs::path& script, const ProgressMonitor& monitor) {
    const ReadingFormerOutput script_may_be_replaced;
    animate::RenderInputs inputs(ProgressMonitor{{}, monitor.stopped},
                                 animate::RenderInputs::Poses::kOnlyKnown);
    const std::shared_ptr<const animate::ScriptInput> input = inputs.script(script);
    const std::shared_ptr<const animate::RigInput> rig =
        inputs.rig(track::read_script_header(input->json).rig_file);
    CacheKey key("studio/thumbnail 1");
    key.add(input->sha256).add(rig->rig.sha256).add(rig->mesh.sha256);
    for (const animate::InputFile& table : rig->tables) key.add(table.sha256);
    const KeptPicture kept = cached_result(
        key.finish(),
        [&] {
            const std::string png =
                media::png_bytes(drawn(input->json, rig->files, monitor), script.string());
            return KeptPicture{{png.begin(), png.end()}};
        },
        [](auto& picture, const auto& visit) { visit(picture.png); });
    return {kept.png.begin(), kept.png.end()};
}

std::string base64_of(const std::string& bytes) {
    constexpr const char* kLetters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group =
                group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k <= bytes.size() ? kLetters[group >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

void StudioThumbnails::ask(const fs::path& script, Json about, serve::WebServer& server,
                           Tell tell) {
    const std::lock_guard lock(mutex_);
    const bool waits = std::any_of(waiting_.begin(), waiting_.end(),
                                   [&](const Wanted& one) { return one.script == script; });
    if (waits || waiting_.size() >= kMostThumbnails) return;
    waiting_.push_back({script, std::move(about), std::move(tell)});
    if (!thread_)
        thread_ = std::make_unique<std::jthread>(
            [this, &server](const std::stop_token& asked) { work(asked, server); });
    came_.notify_one();
}

void StudioThumbnails::work(const std::stop_token& asked, serve::WebServer& server) {
    while (!asked.stop_requested()) {
        Wanted wanted;
        {
            std::unique_lock lock(mutex_);
            if (!came_.wait(lock, asked, [&] { return !waiting_.empty(); })) return;
            wanted = waiting_.front();
        }
        std::string png;
        try {
            png = thumbnail_of(wanted.script,
                               {.progress = {}, .stopped = [&] { return asked.stop_requested(); }});
        } catch (const Interrupted&) {
            return;
        } catch (const std::exception&) {
            // The list has a place without a picture; opening the script says what is wrong.
        }
        wanted.about["png"] = base64_of(png);
        server.post([text = json_text(wanted.about), tell = wanted.tell] { tell(text); });
        const std::lock_guard lock(mutex_);
        if (!waiting_.empty()) waiting_.pop_front();
    }
}

void StudioThumbnails::finish() {
    {
        const std::lock_guard lock(mutex_);
        waiting_.clear();
    }
    thread_.reset();
}

}  // namespace risorius::cli
