// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/bake_shapes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "risorius/blendshapes/detail/random_weights.h"
#include "risorius/blendshapes/detail/shape_files.h"
#include "risorius/blendshapes/detail/shapes_page.h"
#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/face/diagnostics.h"
#include "risorius/io/coarser_model.h"
#include "risorius/io/write_usda.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/report/stopwatch.h"

namespace risorius::blendshapes {

namespace {

Json shape_json(const MadeShape& made, const std::vector<MadeShape>& all) {
    Json out = json_object({{"name", made.goal.name}});
    if (made.goal.partner >= 0) {
        out["partner"] = all[static_cast<std::size_t>(made.goal.partner)].goal.name;
        out["half_of"] = made.goal.sides == Sides::kHalves ? Json(made.goal.whole) : Json();
    }
    if (made.goal.on_top_of >= 0) {
        out["on_top_of"] = all[static_cast<std::size_t>(made.goal.on_top_of)].goal.name;
        out["solved_at"] = made.solved_at;
    }
    out["certificate"] = made.certificate.json();
    return out;
}

// The worst value of every measure over all shapes.
Json worst_of(const MadeShapes& shapes) {
    Json out = Json::object();
    const auto max = [&](const char* name, auto&& value) {
        double worst = 0;
        bool known = false;
        for (const MadeShape& made : shapes.list)
            if (const std::optional<double> one = value(made.certificate)) {
                worst = std::max(worst, *one);
                known = true;
            }
        out[name] = known ? Json(worst) : Json();
    };
    using C = const ShapeCertificate&;
    using Maybe = std::optional<double>;
    const auto mm = [](const Maybe& m) { return m ? Maybe(1e3 * *m) : Maybe(); };
    max("volume_change", [](C c) { return Maybe(std::abs(c.volume_change)); });
    max("lip_depth_mm", [&](C c) { return mm(c.lip_depth_m); });
    max("eye_depth_mm", [&](C c) { return mm(c.eye_depth_m); });
    max("bone_depth_mm", [&](C c) { return mm(c.bone_depth_m); });
    max("rigid_part_mm", [&](C c) { return mm(c.rigid_part_m); });
    max("lid_gap_mm", [&](C c) { return mm(c.lid_gap_m); });
    max("asymmetry_mm", [&](C c) { return mm(c.asymmetry_m); });
    max("largest_stretch", [](C c) { return Maybe(c.stretch.max); });
    out["halves_sum_error_mm"] = 1e3 * shapes.halves_error_m;
    return out;
}

constexpr unsigned kTestSeed = 20051, kFitSeed = 1;  // arbitrary, but they must differ
constexpr long kFittedOfScript = 24;

Json correctives_json(const Correctives& found) {
    Json kept = Json::array(), drivers = Json::array(), tried = Json::array();
    for (const blendshapes::Corrective& one : found.rig.correctives)
        kept.push_back(json_object({{"name", one.name}, {"vertices", one.shape.vertex.size()}}));
    for (const blendshapes::Driver& driver : found.rig.drivers) drivers.push_back(driver.name);
    for (const TriedCorrective& one : found.tried)
        tried.push_back(json_object({{"name", one.name},
                                     {"max_mm", 1e3 * one.max_m},
                                     {"rms_mm", 1e3 * one.rms_m},
                                     {"at_rest", one.at_rest},
                                     {"put_right", one.corrected}}));
    return json_object(
        {{"kept", kept}, {"terms", drivers}, {"tried", tried}, {"bytes", found.bytes}});
}

Json tracks_json(const std::vector<TrackError>& tracks) {
    Json out = Json::array();
    for (const TrackError& track : tracks)
        out.push_back(json_object({{"name", track.name},
                                   {"frames", track.frames},
                                   {"rms_mm", 1e3 * track.rms_m},
                                   {"max_mm", 1e3 * track.max_m},
                                   {"worst_frame", track.frame_of(track.worst)},
                                   {"worst_vertex", track.worst_vertex},
                                   {"rms_without_correctives_mm", 1e3 * track.plain_rms_m},
                                   {"max_without_correctives_mm", 1e3 * track.plain_max_m}}));
    return out;
}

/// Indices of frames of a track, evenly spaced.
std::vector<long> some_frames(long all, int wanted) {
    std::vector<long> out;
    const long count = std::min<long>(all, wanted);
    for (long i = 0; i < count; ++i) out.push_back((2 * i + 1) * all / (2 * count));
    return out;
}

bool wants(const ShapesOptions& options, const char* format) {
    return options.formats.empty() || std::find(options.formats.begin(), options.formats.end(),
                                                format) != options.formats.end();
}

// Whether the hair of the rig is part of the files. Throws Error for another name.
bool has_hair(const ShapesOptions& options) {
    return index_of_name(option_name("hair"), options.hair, {"own", "none"}) == 0;
}

// Writes the head for other programs, as glTF and as USD. Returns the names of the files.
std::vector<std::string> write_models(const scene::RigFiles& files, const face::Face& face,
                                      const ShapesOptions& options, ShapesReport& report,
                                      const std::filesystem::path& folder) {
    // Text is large, so it is written only on request.
    const bool glb = wants(options, "glb"),
               usda = !options.formats.empty() && wants(options, "usda");
    if (!glb && !usda) return {};
    io::MorphModel model =
        morph_model(files, face, report.shapes, report.set, report.correctives.rig,
                    report.animation ? &*report.animation : nullptr, options.texture_px,
                    eyes_named(options.eyes), has_hair(options));
    model.whole_numbers = options.compact;
    std::vector<std::string> written;
    const auto write = [&](const char* name, const std::string& bytes) {
        report::write_text(folder / name, bytes);
        written.emplace_back(name);
    };
    if (glb) write("shapes.glb", io::glb_bytes(model));
    for (int level = 1; glb && level <= options.levels; ++level) {
        io::MorphModel coarse = io::coarser_model(model, std::ldexp(1.0, -level));
        coarse.extras["risorius"]["level"] = level;
        const std::string name = "shapes_lod" + std::to_string(level) + ".glb";
        report.levels.emplace_back(name, io::level_error(model, coarse));
        write(name.c_str(), io::glb_bytes(coarse));
    }
    if (usda) write("shapes.usda", io::usda_text(model));
    return written;
}

// The drive without motion of the head, which blend shapes do not have.
track::Drive unturned(track::Drive drive) {
    for (int k = static_cast<int>(track::Kinematic::kHeadYaw);
         k <= static_cast<int>(track::Kinematic::kHeadSide); ++k)
        drive.kinematic[static_cast<std::size_t>(k)] = 0;
    return drive;
}

// The frames that correctives are fitted to: frames of the script, and of a track of action units as they occur in faces.
ScriptFrames frames_to_fit(const ShapesReport& report, const track::ChannelTable& channels,
                           int random_frames) {
    ScriptFrames out;
    const auto shapes = static_cast<long>(report.shapes.list.size());
    const std::vector<Eigen::VectorXd> random =
        random_facs_track(report.shapes, random_frames, kFitSeed);
    const long scripted = report.animation ? report.animation->weights.rows() : 0;
    out.weights.resize(scripted + static_cast<long>(random.size()), shapes);
    if (scripted > 0) out.weights.topRows(scripted) = report.animation->weights;
    // Starts at the first frame, so that these frames lie between those on which the rig is tested.
    const long some = std::min(kFittedOfScript, scripted);
    for (long i = 0; i < some; ++i) {
        out.simulated.push_back(i * scripted / some);
        out.drives.push_back(
            unturned(report.animation->drives[static_cast<std::size_t>(out.simulated.back())]));
    }
    for (const Eigen::VectorXd& frame : random) {
        const long at = scripted + static_cast<long>(out.simulated.size()) - some;
        out.weights.row(at) = frame.transpose();
        out.simulated.push_back(at);
        out.drives.push_back(drive_of_weights(report.shapes, frame, channels));
    }
    return out;
}

// Compares the blend shape rig with the simulation, frame by frame.
std::vector<TrackError> compare_tracks(const scene::RigFiles& files, const ShapeSolver& solver,
                                       const ShapesOptions& options, const ShapesReport& report,
                                       const ProgressMonitor& monitor) {
    const track::ChannelTable channels = files.rig.channels();
    struct Track {
        std::string name;
        std::vector<Eigen::VectorXd> weights;
        std::vector<track::Drive> drives = {};
        std::vector<long> frames = {};
    };
    std::vector<Track> tracks;
    tracks.push_back(
        {"random weights", random_weights(report.shapes, options.test_frames, kTestSeed)});
    std::vector<Eigen::VectorXd> facs =
        random_facs_track(report.shapes, options.test_frames, kTestSeed);
    if (!facs.empty()) tracks.push_back({"random FACS track", std::move(facs)});
    for (Track& track : tracks)
        for (const Eigen::VectorXd& one : track.weights)
            track.drives.push_back(drive_of_weights(report.shapes, one, channels));
    if (report.animation) {
        const ShapeAnimation& script = *report.animation;
        Track& track = tracks.emplace_back(Track{script.name, {}});
        track.frames = some_frames(script.weights.rows(), options.test_frames);
        for (const long f : track.frames) {
            track.weights.push_back(script.weights.row(f).transpose());
            track.drives.push_back(unturned(script.drives[static_cast<std::size_t>(f)]));
        }
    }
    std::vector<TrackError> out;
    const auto all = static_cast<double>(tracks.size());
    for (const Track& track : tracks) {
        const auto done = static_cast<double>(out.size());
        out.push_back(track_error(track.name, report.correctives.rig, solver, track.drives,
                                  track.weights, monitor.subrange(done / all, (done + 1) / all)));
        out.back().of_track = track.frames;
    }
    return out;
}

/// Whether a format has every vertex in every frame of a script.
bool is_cache(const std::string& format) {
    return format == "cache" || format == "pc2" || format == "mdd";
}

/// Throws Error for values that are not allowed, and for formats and options that would come to nothing.
void check_options(const ShapesOptions& options) {
    for (const std::string& format : options.formats) {
        index_of_name(option_name("formats"), format, shape_formats());
        if ((is_cache(format) || format == "csv") && options.script.empty())
            throw Error(option_name("formats"),
                        option_name("script") + " with " + in_quotes(format) +
                            ", which has the frames of a script",
                        "none");
        if (format == "csv" && options.set != "arkit52")
            throw Error(option_name("formats"), "the set \"arkit52\" with \"csv\"",
                        in_quotes(options.set));
    }
    if (options.head_turns &&
        std::none_of(options.formats.begin(), options.formats.end(), is_cache))
        throw Error(option_name("head_turns"),
                    "cache, pc2 or mdd among " + option_name("formats") + ", which it changes",
                    "none");
    constexpr int kMin_px = 256, kMax_px = 4096;
    for (const auto& [name, px] :
         {std::pair{"texture_px", options.texture_px}, {"maps_px", options.maps_px}})
        if (px != 0 && (px < kMin_px || px > kMax_px))
            throw Error(option_name(name),
                        "0 or " + std::to_string(kMin_px) + ".." + std::to_string(kMax_px),
                        std::to_string(px));
    if (options.levels < 0 || options.levels > kMaxLevels)
        throw Error(option_name("levels"), "0.." + std::to_string(kMaxLevels),
                    std::to_string(options.levels));
    eyes_named(options.eyes);
    has_hair(options);
}

}  // namespace

const std::vector<std::string>& shape_formats() {
    static const std::vector<std::string> kNames{"glb",   "obj", "table", "csv",
                                                 "cache", "pc2", "mdd",   "usda"};
    return kNames;
}

int ShapesReport::complaints() const {
    return static_cast<int>(std::count_if(
        shapes.list.begin(), shapes.list.end(),
        [](const MadeShape& made) { return !made.certificate.complaints().empty(); }));
}

Json ShapesReport::json() const {
    const ShapeLimits limits;
    Json list = Json::array(), left = Json::object(), bytes = Json::object();
    for (const MadeShape& made : shapes.list) list.push_back(shape_json(made, shapes.list));
    for (const auto& [shape, why] : left_out) left[shape] = why;
    for (const auto& [file, size] : sizes) bytes[file] = size;
    Json coarser = Json::array();
    for (const auto& [file, error] : levels)
        coarser.push_back(json_object({{"file", file},
                                       {"triangles", error.triangles},
                                       {"surface_mm", 1e3 * error.surface_m},
                                       {"shape_rms_mm", 1e3 * error.shape_rms_m},
                                       {"shape_max_mm", 1e3 * error.shape_max_m}}));
    Json out = json_object({{"format", "risorius-shapes-certificate"},
                            {"version", 1},
                            {"name", name},
                            {"rig", rig},
                            {"set", set},
                            {"quality", quality},
                            {"vertices", vertices},
                            {"nodes", nodes},
                            {"mirrored", shapes.mirrored},
                            {"limits", json_object({{"volume_change", limits.volume_ratio},
                                                    {"penetration_mm", 1e3 * limits.penetration_m},
                                                    {"lid_gap_mm", 1e3 * limits.lid_gap_m},
                                                    {"rigid_part_mm", 1e3 * limits.rigid_part_m},
                                                    {"asymmetry_mm", 1e3 * limits.asymmetry_m}})},
                            {"beyond_limits", complaints()},
                            {"worst", worst_of(shapes)},
                            {"shapes", list},
                            {"linear_rig", tracks_json(tracks)},
                            {"correctives", correctives_json(correctives)},
                            {"left_out", left},
                            {"levels", coarser},
                            {"bytes", bytes}});
    if (maps) out["maps"] = maps->json();
    return out;
}

ShapesReport bake_shapes(const ShapesOptions& options, const ProgressMonitor& monitor) {
    check_options(options);
    const scene::RigFiles files = scene::read_rig_files(options.rig, monitor.stopped);
    const ShapeSet set = shape_set(files.rig, options.set, options.only, files.place());
    report::AtomicFolder folder(options.out);

    // Approximate fractions of the run time
    const double solved = 0.35, corrected = options.correctives ? 0.65 : solved,
                 compared = options.test_frames > 0 ? corrected + 0.15 : corrected;
    const report::Stopwatch time;
    const ShapeSolver solver(files, face::quality_named(options.quality), options.threads);
    const rig::Head& head = solver.face().head();
    ShapesReport report;
    if (!options.script.empty()) {
        const std::unique_ptr<face::Face> face = solver.another();
        report.animation = bake_script(options.script, files, set.goals,
                                       ShapeWeights(*face, files.rig.channels(), set.goals));
    }
    report.shapes = make_shapes(files, set, solver, monitor.subrange(0, solved));
    CorrectiveOptions corrective = correctives_of_set(set.name);
    corrective.named = options.named_correctives;
    corrective.pairs = options.pairs.value_or(corrective.pairs);
    corrective.tolerance_m = options.corrective_tolerance_m.value_or(corrective.tolerance_m);
    corrective.budget_bytes = options.corrective_bytes.value_or(corrective.budget_bytes);
    if (options.correctives)
        report.correctives =
            find_correctives(files, report.shapes, solver, corrective,
                             frames_to_fit(report, files.rig.channels(), corrective.random_frames),
                             monitor.subrange(solved, corrected));
    else
        for (const MadeShape& made : report.shapes.list)
            report.correctives.rig.shapes.push_back(made.shape);
    if (options.test_frames > 0)
        report.tracks =
            compare_tracks(files, solver, options, report, monitor.subrange(corrected, compared));
    report.solving_s = time.seconds();
    report.name = files.rig.name;
    report.rig = options.rig.generic_string();
    report.set = set.name;
    report.quality = options.quality;
    report.channels = files.rig.channels();
    report.left_out = set.left_out;
    report.vertices = static_cast<int>(head.vertices.rows());
    report.nodes = solver.face().diagnostics().node_count();

    // Files for other programs
    std::vector<std::string> written{"index.html", "results.json"};
    const auto keep = [&](const std::vector<std::string>& names) {
        written.insert(written.end(), names.begin(), names.end());
        for (const std::string& name : names)
            report.sizes.emplace_back(
                name, static_cast<long>(std::filesystem::file_size(folder.partial() / name)));
    };
    keep(write_models(files, solver.face(), options, report, folder.partial()));
    if (report.animation && set.name == "arkit52" && wants(options, "csv")) {
        report::write_text(folder.partial() / "live_link.csv", live_link_table(*report.animation));
        keep({"live_link.csv"});
    }
    // Caches are large, so they are written only on request.
    if (report.animation && std::any_of(options.formats.begin(), options.formats.end(), is_cache))
        keep(write_vertex_cache(files, solver.face(), report.correctives.rig, *report.animation,
                                options.formats, options.head_turns, folder.partial()));
    if (wants(options, "table"))
        keep(write_shape_table(files, head, report.shapes, folder.partial()));
    if (wants(options, "obj")) keep(write_shape_objs(files, head, report.shapes, folder.partial()));
    if (options.maps_px > 0) {
        report.maps =
            write_shape_maps(files, solver.face(), report.shapes, options.maps_px, folder.partial(),
                             options.threads, monitor.subrange(compared, compared));
        keep(report.maps->files());
    }

    // Files for people
    std::optional<ShapesPictures> pictures;
    if (options.pictures) {
        pictures =
            draw_shapes(report, files, head, folder.partial(), monitor.subrange(compared, 1));
        written.insert(written.end(), pictures->files.begin(), pictures->files.end());
    }
    report::write_text(folder.partial() / "index.html",
                       shapes_page(report, pictures ? &*pictures : nullptr));
    Json json = report.json();
    json[report::kFilesKey] = written;
    report::write_text(folder.partial() / "results.json", json_text(json, 2) + "\n");
    monitor.throw_if_stopped();
    folder.commit();
    return report;
}

}  // namespace risorius::blendshapes
