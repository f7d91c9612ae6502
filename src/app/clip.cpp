#include "app/clip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/contact_sheet.h"
#include "app/film.h"
#include "app/frame_rows.h"
#include "app/staged_file.h"
#include "app/version.h"
#include "core/error.h"
#include "media/image_file.h"
#include "media/phase_scramble.h"
#include "media/sha256.h"
#include "media/sync_marks.h"
#include "track/timeline.h"

namespace risorius::app {

namespace fs = std::filesystem;
using stimuli::ControlKind;

namespace {

// About, on two cores: seconds for a frame and for its pixels, and bytes for a pixel
constexpr double kFrame_s = 0.027, kPixel_s = 7e-8, kByte_px = 0.03, kLosslessByte_px = 1.2;
constexpr double kMostHeld_bytes = 1.5e9;  // of frames that are shown in another order
constexpr int kStrip = 5, kThumb_px = 120;
constexpr int kPhotodiode_px = 64;

std::string sha256_of(const std::string& text) {
    media::Sha256 hash;
    hash.add(text.data(), text.size());
    return hash.finish();
}

bool shows_other_order(ControlKind kind) {
    return kind == ControlKind::kReversed || kind == ControlKind::kScrambled ||
           kind == ControlKind::kApex;
}

bool shows_part(ControlKind kind) {
    return kind == ControlKind::kEyesOnly || kind == ControlKind::kMouthOnly;
}

/// The script's files, as keys in it: where each stands, relative to `folder` or not.
std::vector<Json::json_pointer> file_keys(const Json& script) {
    std::vector<Json::json_pointer> out;
    for (const char* key : {"/rig", "/emg/file", "/view/light/file"})
        if (const Json::json_pointer at(key); script.contains(at) && script.at(at).is_string())
            out.push_back(at);
    return out;
}

/// The same script for a file in another folder.
Json relocated(Json script, const fs::path& from, const fs::path& to) {
    for (const Json::json_pointer& key : file_keys(script)) {
        const fs::path file = script.at(key).get<std::string>();
        if (file.is_relative())
            script[key] =
                fs::relative(fs::absolute(from / file), fs::absolute(to)).generic_string();
    }
    return script;
}

fs::path script_file(const ClipPlan& plan) {
    return fs::path("code/scripts") / (plan.condition.clip + ".json");
}

std::string stem(const ClipPlan& plan) { return "stimuli/stim-" + plan.condition.clip; }

/// What of a picture a window leaves, soft at its edge; the rest is background.
struct Window {
    double left = 0, top = 0, right = 0, bottom = 0;

    void show(const std::array<std::uint8_t, 3>& outside, Image& image) const {
        const double soft = 0.08 * (right - left);
        for (int y = 0; y < image.height_px; ++y)
            for (int x = 0; x < image.width_px; ++x) {
                const double away = std::max({left - x, x - right, top - y, y - bottom, 0.0});
                const double share =
                    away >= soft ? 0.0 : 0.5 * (1 + std::cos(3.14159265358979 * away / soft));
                std::uint8_t* pixel = image.pixel(x, y);
                for (int k = 0; k < 3; ++k)
                    pixel[k] = static_cast<std::uint8_t>(std::lround(
                        share * pixel[k] + (1 - share) * outside[static_cast<std::size_t>(k)]));
            }
    }
};

/// Around the landmarks of eyes or mouth, wherever they are in any frame: a window that stands still.
Window window_around(const FrameRows& rows, ControlKind kind, const std::string& place) {
    const std::vector<std::string> ids =
        kind == ControlKind::kEyesOnly
            ? std::vector<std::string>{"en_l", "en_r", "ex_l", "ex_r",
                                       "ps_l", "ps_r", "pi_l", "pi_r"}
            : std::vector<std::string>{"ch_l", "ch_r", "ls", "li", "sto", "stos", "stoi"};
    double width = 0;
    Window out{1e9, 1e9, -1e9, -1e9};
    for (const std::string& id : ids) {
        const int u = rows.column(id + ".u_px"), v = rows.column(id + ".v_px");
        if (u < 0 || v < 0) continue;
        for (int r = 0; r < rows.rows(); ++r) {
            out.left = std::min(out.left, rows.number(r, u));
            out.right = std::max(out.right, rows.number(r, u));
            out.top = std::min(out.top, rows.number(r, v));
            out.bottom = std::max(out.bottom, rows.number(r, v));
        }
    }
    width = out.right - out.left;
    if (!(width > 0))
        throw Error(place, "a rig with landmarks of eyes and mouth", "none to put a window around");
    const double beside = 0.12 * width,
                 above = (kind == ControlKind::kEyesOnly ? 0.16 : 0.2) * width;
    return {out.left - beside, out.top - above, out.right + beside, out.bottom + above};
}

void turn_upside_down(Image& image) {
    std::vector<std::uint8_t> turned(image.rgba.size());
    const std::size_t pixels = image.rgba.size() / 4;
    for (std::size_t i = 0; i < pixels; ++i)
        std::copy_n(&image.rgba[4 * i], 4, &turned[4 * (pixels - 1 - i)]);
    image.rgba = std::move(turned);
}

std::string text_of(double value, int decimals) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

/// A row for every frame as it is shown.
std::string events_table(const FrameRows& rows, const std::vector<int>& order,
                         const ClipPlan& plan) {
    std::string out = "onset\tduration\tframe\tsource_frame";
    for (std::size_t c = 2; c < rows.names.size(); ++c) out += "\t" + rows.names[c];
    if (plan.clips.photodiode) out += "\tphotodiode";
    out += "\n";
    const bool turned = plan.condition.control.kind == ControlKind::kUpsideDown;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto& cells = rows.cells[static_cast<std::size_t>(order[i])];
        out += text_of(static_cast<double>(i) / plan.fps, 6) + "\t" + text_of(1.0 / plan.fps, 6) +
               "\t" + std::to_string(i) + "\t" + std::to_string(order[i]);
        for (std::size_t c = 2; c < rows.names.size(); ++c) {
            const std::string& name = rows.names[c];
            const auto ends = [&](const char* end) {
                return name.size() > 5 && name.compare(name.size() - 5, 5, end) == 0;
            };
            if (turned && (ends(".u_px") || ends(".v_px")))
                out += "\t" + text_of((ends(".u_px") ? plan.width_px : plan.height_px) -
                                          rows.number(order[i], static_cast<int>(c)),
                                      3);
            else
                out += "\t" + cells[c];
        }
        if (plan.clips.photodiode) out += i % 2 == 0 ? "\t1" : "\t0";
        out += "\n";
    }
    return out;
}

/// The pictures of a film on their way into a video.
class ClipPictures {
  public:
    ClipPictures(const ClipPlan& plan, media::VideoWriter& video,
                 const std::array<std::uint8_t, 3>& background)
        : plan_(plan),
          kind_(plan.condition.control.kind),
          background_(background),
          video_(video),
          later_(shows_other_order(kind_) || shows_part(kind_)) {
        if (kind_ == ControlKind::kPhaseScrambled)
            phases_.emplace(plan.width_px, plan.height_px, plan.condition.seed);
    }

    void take(Image image) {
        if (later_)
            held_.push_back(std::move(image));
        else
            write(std::move(image));
    }
    /// What had to wait for all that is known in the end.
    void finish(const FrameRows& rows, const std::vector<int>& order) {
        if (!later_) return;
        std::optional<Window> window;
        if (shows_part(kind_)) window = window_around(rows, kind_, plan_.condition.clip);
        for (const int frame : order) {
            Image image = held_[static_cast<std::size_t>(frame)];
            if (window) window->show(background_, image);
            write(std::move(image));
        }
    }
    /// A few frames over the length of the clip, side by side.
    Image strip() const {
        const Image& first = thumbs_.front();
        Image out(kStrip * first.width_px, first.height_px);
        for (int i = 0; i < kStrip; ++i) {
            const std::size_t at =
                (2 * static_cast<std::size_t>(i) + 1) * thumbs_.size() / (2 * kStrip);
            for (int y = 0; y < first.height_px; ++y)
                std::copy_n(thumbs_[at].pixel(0, y), 4 * first.width_px,
                            out.pixel(i * first.width_px, y));
        }
        return out;
    }
    std::string sha256() { return hash_.finish(); }

  private:
    void write(Image image) {
        if (kind_ == ControlKind::kUpsideDown) turn_upside_down(image);
        if (phases_) phases_->scramble(image);
        const int height = std::min(kThumb_px, image.height_px);
        thumbs_.push_back(
            shrunk(image, std::max(1, image.width_px * height / image.height_px), height));
        if (plan_.clips.photodiode)
            media::draw_photodiode(media::corner_named(*plan_.clips.photodiode, "photodiode"),
                                   std::min(kPhotodiode_px, image.width_px / 8), written_ % 2 == 0,
                                   image);
        ++written_;
        hash_.add(image.rgba.data(), image.rgba.size());
        video_.append(image);
    }

    const ClipPlan& plan_;
    ControlKind kind_;
    std::array<std::uint8_t, 3> background_;
    media::VideoWriter& video_;
    bool later_;
    std::optional<media::PhaseScrambler> phases_;
    int written_ = 0;
    std::vector<Image> held_, thumbs_;
    media::Sha256 hash_;
};

/// In any frame.
bool moves_the_head(const track::ScriptDescription& script, const track::ChannelTable& channels,
                    const ClipPlan& plan) {
    const track::Timeline timeline(script, channels);
    for (int frame = 0; frame < plan.frames; ++frame) {
        const track::Drive drive = timeline.at(static_cast<double>(frame) / plan.fps);
        for (int k = static_cast<int>(track::Kinematic::kHeadYaw);
             k <= static_cast<int>(track::Kinematic::kHeadSide); ++k)
            if (drive.kinematic[static_cast<std::size_t>(k)] != 0) return true;
    }
    return false;
}

/// How it was made, without what differs from one making to the next and from one folder to another.
Json run_without_places(const RunRecord& record) {
    Json json = record.json();
    for (const char* key : {"out", "timing", "script"}) json.erase(key);
    const auto name_only = [](Json& file) {
        file["file"] = fs::path(file.at("file").get<std::string>()).filename().generic_string();
    };
    for (const char* key : {"rig", "mesh"}) name_only(json[key]);
    for (const char* key : {"tables", "recordings"})
        for (Json& file : json[key]) name_only(file);
    return json;
}

}  // namespace

double ClipPlan::seconds() const { return frames * (kFrame_s + kPixel_s * width_px * height_px); }
double ClipPlan::megabytes() const {
    return 1e-6 * frames * (clips.lossless || clips.ending == "mkv" ? kLosslessByte_px : kByte_px) *
           width_px * height_px;
}

const RigDigests::Known& RigDigests::at(const fs::path& rig) {
    const fs::path key = fs::weakly_canonical(rig);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    RigFiles files = read_rig_files(rig);
    std::string digests =
        media::sha256_of_file(files.file) + media::sha256_of_file(files.rig.mesh_file);
    for (const fs::path& table : files.rig.table_files) digests += media::sha256_of_file(table);
    return known_.emplace(key, Known{std::move(files), sha256_of(digests)}).first->second;
}

ClipPlan plan_clip(const stimuli::Condition& condition, const stimuli::ClipOptions& clips,
                   RigDigests& rigs) {
    ClipPlan plan;
    plan.condition = condition;
    plan.clips = clips;
    // As if it were a file beside the template, so that messages and relative paths are right
    const JsonCursor json = JsonCursor::from_json(
        condition.script, (condition.folder / ("clip " + condition.clip)).string());
    const track::ScriptHeader header = track::read_script_header(json);
    const RigDigests::Known& rig = rigs.at(header.rig_file);
    const track::ScriptDescription script = track::read_script(
        json, rig.files.rig.channels(), rig.files.rig.facs, rig.files.rig.expressions);
    plan.frames = header.frame_count();
    plan.fps = header.fps;
    plan.width_px = header.view.width_px;
    plan.height_px = header.view.height_px;
    const ControlKind kind = condition.control.kind;
    if ((shows_other_order(kind) || shows_part(kind)) &&
        4.0 * plan.frames * plan.width_px * plan.height_px > kMostHeld_bytes)
        throw Error(json.place(),
                    "fewer or smaller frames for the control " + condition.control.name() +
                        ", which keeps them in memory",
                    std::to_string(plan.frames) + " of " + std::to_string(plan.width_px) + " x " +
                        std::to_string(plan.height_px));
    if (kind == ControlKind::kFlipped && moves_the_head(script, rig.files.rig.channels(), plan))
        throw Error(json.place(), "a head that keeps still, for the control flipped",
                    "one that the script moves");
    if (clips.photodiode) media::corner_named(*clips.photodiode, "clips/photodiode");

    // All that the clip hangs on
    Json content{{"toolkit", kVersion},
                 {"compiler", __VERSION__},
                 {"script", condition.script},
                 {"rig", rig.sha256},
                 {"control", condition.control.name()},
                 {"seed", kind == ControlKind::kScrambled || kind == ControlKind::kPhaseScrambled
                              ? condition.seed
                              : 0u},
                 {"ending", clips.ending},
                 {"quality", clips.quality},
                 {"crf", clips.crf ? Json(*clips.crf) : Json()},
                 {"lossless", clips.lossless},
                 {"landmarks", clips.landmarks},
                 {"photodiode", clips.photodiode ? Json(*clips.photodiode) : Json()}};
    for (const Json::json_pointer& key : file_keys(condition.script)) {
        content["script"][key] = "";
        const fs::path file = condition.script.at(key).get<std::string>();
        if (key.to_string() != "/rig")
            content["files"].push_back(
                media::sha256_of_file(file.is_relative() ? condition.folder / file : file));
    }
    plan.content_sha256 = sha256_of(content.dump());
    return plan;
}

std::vector<fs::path> clip_files(const ClipPlan& plan) {
    return {script_file(plan), fs::path("overview") / (plan.condition.clip + ".png"),
            stem(plan) + "_video." + plan.clips.ending, stem(plan) + "_annot-frames_events.tsv",
            stem(plan) + "_video.json"};
}

Json clip_record(const ClipPlan& plan, const fs::path& folder) {
    return JsonCursor::read_file(folder / clip_files(plan).back()).json();
}

bool is_made(const ClipPlan& plan, const fs::path& folder) {
    const std::vector<fs::path> files = clip_files(plan);
    if (!fs::exists(folder / files.back())) return false;
    try {
        const Json record = clip_record(plan, folder);
        if (record.value("content_sha256", "") != plan.content_sha256) return false;
        for (std::size_t i = 0; i + 1 < files.size(); ++i)
            if (!fs::exists(folder / files[i]) ||
                record.at("files").value(files[i].generic_string(), "") !=
                    media::sha256_of_file(folder / files[i]))
                return false;
        return true;
    } catch (const std::exception&) {
        return false;  // something else, or half of it: made again
    }
}

void make_clip(const ClipPlan& plan, const fs::path& folder, int threads, const Watch& watch,
               Studio& studio) {
    const std::vector<fs::path> files = clip_files(plan);
    for (const fs::path& file : files) fs::create_directories((folder / file).parent_path());
    // Not complete from here on
    fs::remove(folder / files.back());
    const fs::path script = folder / script_file(plan), video_file = folder / files[2];
    write_text(
        script,
        relocated(plan.condition.script, plan.condition.folder, script.parent_path()).dump(2) +
            "\n");

    AnimateOptions options;
    options.script = script;
    options.out = video_file;
    options.quality = plan.clips.quality;
    options.video.crf = plan.clips.crf;
    options.video.lossless = plan.clips.lossless;
    options.landmarks = plan.clips.landmarks || shows_part(plan.condition.control.kind) ||
                        plan.condition.control.kind == ControlKind::kApex;
    options.threads = threads;
    options.flipped_motion = plan.condition.control.kind == ControlKind::kFlipped;
    const Shot shot = plan_shot(options);
    std::array<std::uint8_t, 3> background{};
    for (std::size_t k = 0; k < 3; ++k)
        background[k] = static_cast<std::uint8_t>(std::lround(255 * shot.view.background.rgb[k]));
    media::VideoWriter video(video_file, shot.video);
    ClipPictures pictures(plan, video, background);
    FilmExtras extras;
    const RunRecord run = film(
        options, shot, [&](Image image) { pictures.take(std::move(image)); }, extras, watch,
        studio);
    const FrameRows rows = frame_rows(extras.table);
    const Moments moments = moments_of(landmark_ways(rows));
    const std::vector<int> order = stimuli::frame_order(plan.condition.control, shot.frames,
                                                        moments.apex, plan.condition.seed);
    pictures.finish(rows, order);

    // Each whole or not at all, the sidecar last
    video.finish();
    write_text(folder / files[3], events_table(rows, order, plan));
    media::write_png(pictures.strip(), folder / files[1]);
    const auto shown_at = [&](int frame) {
        return static_cast<int>(std::find(order.begin(), order.end(), frame) - order.begin());
    };
    Json record{{"format", "risorius-clip"},
                {"version", 1},
                {"stim_id", plan.condition.clip},
                {"set", plan.condition.set},
                {"control", plan.condition.control.name()},
                {"of", plan.condition.of},
                {"values", Json::object()},
                {"frames", shot.frames},
                {"fps", plan.fps},
                {"duration_s", static_cast<double>(shot.frames) / plan.fps},
                {"movement_onset_frame", shown_at(moments.onset)},
                {"apex_frame", shown_at(moments.apex)},
                {"pictures_sha256", pictures.sha256()},
                {"content_sha256", plan.content_sha256},
                {"files", Json::object()},
                {"run", run_without_places(run)}};
    for (const auto& [name, value] : plan.condition.values) record["values"][name] = value;
    for (std::size_t i = 0; i + 1 < files.size(); ++i)
        record["files"][files[i].generic_string()] = media::sha256_of_file(folder / files[i]);
    write_text(folder / files.back(), record.dump(2) + "\n");
}

}  // namespace risorius::app
