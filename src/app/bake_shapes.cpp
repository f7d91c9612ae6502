#include "app/bake_shapes.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/shape_files.h"
#include "app/shapes_page.h"
#include "app/staged_file.h"
#include "app/staged_folder.h"
#include "app/stopwatch.h"
#include "core/known_names.h"

namespace risorius::app {

namespace {

Json shape_json(const MadeShape& made, const std::vector<MadeShape>& all) {
    Json out{{"name", made.goal.name}};
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

// The greatest of every number over all shapes.
Json worst_of(const MadeShapes& shapes) {
    Json out = Json::object();
    const auto greatest = [&](const char* name, auto&& value) {
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
    greatest("volume_change", [](C c) { return Maybe(std::abs(c.volume_change)); });
    greatest("lip_depth_mm", [&](C c) { return mm(c.lip_depth_m); });
    greatest("eye_depth_mm", [&](C c) { return mm(c.eye_depth_m); });
    greatest("bone_depth_mm", [&](C c) { return mm(c.bone_depth_m); });
    greatest("lid_gap_mm", [&](C c) { return mm(c.lid_gap_m); });
    greatest("asymmetry_mm", [&](C c) { return mm(c.asymmetry_m); });
    greatest("largest_stretch", [](C c) { return Maybe(c.stretch.greatest); });
    out["halves_sum_error_mm"] = 1e3 * shapes.halves_error_m;
    return out;
}

constexpr unsigned kTestSeed = 20051;  // any would do

Json correctives_json(const Correctives& found, const std::vector<MadeShape>& all) {
    Json kept = Json::array(), tried = Json::array();
    for (const shapes::Corrective& one : found.rig.correctives) {
        Json drivers = Json::array();
        for (const int driver : one.drivers)
            drivers.push_back(all[static_cast<std::size_t>(driver)].goal.name);
        kept.push_back({{"name", one.name},
                        {"drivers", drivers},
                        {"weight", weight_rule(one)},
                        {"vertices", one.shape.vertex.size()}});
    }
    for (const TriedCorrective& one : found.tried)
        tried.push_back({{"name", one.name},
                         {"max_mm", 1e3 * one.greatest_m},
                         {"rms_mm", 1e3 * one.rms_m},
                         {"at_rest", one.at_rest},
                         {"kept", one.kept}});
    return {{"kept", kept}, {"tried", tried}};
}

Json tracks_json(const std::vector<TrackError>& tracks) {
    Json out = Json::array();
    for (const TrackError& track : tracks)
        out.push_back({{"name", track.name},
                       {"frames", track.frames},
                       {"rms_mm", 1e3 * track.rms_m},
                       {"max_mm", 1e3 * track.greatest_m},
                       {"worst_frame", track.frame_of(track.worst)},
                       {"worst_vertex", track.worst_vertex},
                       {"rms_without_correctives_mm", 1e3 * track.plain_rms_m},
                       {"max_without_correctives_mm", 1e3 * track.plain_greatest_m}});
    return out;
}

/// So many of a track's frames, evenly.
std::vector<long> some_frames(long all, int wanted) {
    std::vector<long> out;
    const long count = std::min<long>(all, wanted);
    for (long i = 0; i < count; ++i) out.push_back((2 * i + 1) * all / (2 * count));
    return out;
}

/// Of the whole run, what a part of it tells.
Watch part_of(const Watch& watch, double from, double to) {
    Watch out = watch;
    if (watch.progress)
        out.progress = [&watch, from, to](double share, const std::string& what) {
            watch.progress(from + (to - from) * share, what);
        };
    return out;
}

bool wants(const ShapesOptions& options, const char* format) {
    return options.formats.empty() || std::find(options.formats.begin(), options.formats.end(),
                                                format) != options.formats.end();
}

// Blend shapes do not turn the head.
PlayedFrames unturned(const ShapeAnimation& animation) {
    PlayedFrames out{animation.weights, animation.drives};
    for (track::Drive& drive : out.drives)
        for (int k = static_cast<int>(track::Kinematic::kHeadYaw);
             k <= static_cast<int>(track::Kinematic::kHeadSide); ++k)
            drive.kinematic[static_cast<std::size_t>(k)] = 0;
    return out;
}

// The linear rig against the simulation, frame by frame: on weights drawn at random, and on the script.
std::vector<TrackError> compare_tracks(const RigFiles& files, const ShapeSolver& solver,
                                       const ShapesOptions& options, const ShapesReport& report,
                                       const PlayedFrames& played, const Watch& watch) {
    const track::ChannelTable channels = files.rig.channels();
    std::vector<TrackError> out;
    const std::vector<Eigen::VectorXd> weights =
        random_weights(report.shapes, options.test_frames, kTestSeed);
    std::vector<track::Drive> drives;
    for (const Eigen::VectorXd& one : weights)
        drives.push_back(drive_of_weights(report.shapes, one, channels));
    const bool scripted = report.animation.has_value();
    out.push_back(track_error("random weights", report.correctives.rig, solver, drives, weights,
                              part_of(watch, 0, scripted ? 0.5 : 1)));
    if (!scripted) return out;
    std::vector<Eigen::VectorXd> some;
    drives.clear();
    const std::vector<long> frames = some_frames(played.weights.rows(), options.test_frames);
    for (const long f : frames) {
        some.push_back(played.weights.row(f).transpose());
        drives.push_back(played.drives[static_cast<std::size_t>(f)]);
    }
    out.push_back(track_error(report.animation->name, report.correctives.rig, solver, drives, some,
                              part_of(watch, 0.5, 1)));
    out.back().of_track = frames;
    return out;
}

}  // namespace

const std::vector<std::string>& shape_formats() {
    static const std::vector<std::string> kNames{"glb", "obj", "table", "csv", "cache"};
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
    return {{"format", "risorius-shapes-certificate"},
            {"version", 1},
            {"name", name},
            {"rig", rig},
            {"set", set},
            {"quality", quality},
            {"vertices", vertices},
            {"nodes", nodes},
            {"mirrored", shapes.mirrored},
            {"limits",
             {{"volume_change", limits.volume_ratio},
              {"penetration_mm", 1e3 * limits.penetration_m},
              {"lid_gap_mm", 1e3 * limits.lid_gap_m},
              {"asymmetry_mm", 1e3 * limits.asymmetry_m}}},
            {"beyond_limits", complaints()},
            {"worst", worst_of(shapes)},
            {"shapes", list},
            {"linear_rig", tracks_json(tracks)},
            {"correctives", correctives_json(correctives, shapes.list)},
            {"left_out", left},
            {"bytes", bytes}};
}

ShapesReport bake_shapes(const ShapesOptions& options, const Watch& watch) {
    for (const std::string& format : options.formats)
        index_of_name("--formats", format, shape_formats());
    const RigFiles files = read_rig_files(options.rig);
    const ShapeSet set = shape_set(files.rig, options.set, options.only, files.place());
    StagedFolder folder(options.out);

    // About, of the time of a run
    const double solved = 0.35, corrected = options.correctives ? 0.65 : solved,
                 compared = options.test_frames > 0 ? corrected + 0.15 : corrected;
    const Stopwatch time;
    const ShapeSolver solver(files, sim::quality_named(options.quality), options.threads);
    const rig::Head& head = solver.face().head();
    ShapesReport report;
    if (!options.script.empty()) {
        const std::unique_ptr<sim::Face> face = solver.another();
        report.animation = bake_script(options.script, files, set.goals,
                                       ShapeWeights(*face, files.rig.channels(), set.goals));
    }
    const PlayedFrames played = report.animation ? unturned(*report.animation) : PlayedFrames();
    report.shapes = make_shapes(files, set, solver, part_of(watch, 0, solved));
    if (options.correctives)
        report.correctives = find_correctives(files, report.shapes, solver, options.corrective,
                                              played, part_of(watch, solved, corrected));
    else
        for (const MadeShape& made : report.shapes.list)
            report.correctives.rig.shapes.push_back(made.shape);
    if (options.test_frames > 0)
        report.tracks = compare_tracks(files, solver, options, report, played,
                                       part_of(watch, corrected, compared));
    report.solving_s = time.seconds();
    report.name = files.rig.name;
    report.rig = options.rig.generic_string();
    report.set = set.name;
    report.quality = options.quality;
    report.channels = files.rig.channels();
    report.left_out = set.left_out;
    report.vertices = static_cast<int>(head.vertices.rows());
    report.nodes = solver.face().node_count();

    // What other programs read
    std::vector<std::string> written{"index.html", "results.json"};
    const auto keep = [&](const std::vector<std::string>& names) {
        written.insert(written.end(), names.begin(), names.end());
        for (const std::string& name : names)
            report.sizes.emplace_back(
                name, static_cast<long>(std::filesystem::file_size(folder.partial() / name)));
    };
    if (wants(options, "glb")) {
        io::MorphModel model =
            morph_model(files, head, report.shapes, set.name, report.correctives.rig,
                        report.animation ? &*report.animation : nullptr);
        model.whole_numbers = !options.floats;
        write_text(folder.partial() / "shapes.glb", io::glb_bytes(model));
        keep({"shapes.glb"});
    }
    if (report.animation && set.name == "arkit52" && options.only.empty() &&
        wants(options, "csv")) {
        write_text(folder.partial() / "live_link.csv", live_link_table(*report.animation));
        keep({"live_link.csv"});
    }
    // Of some size, so only when it is asked for by name
    if (report.animation && !options.formats.empty() && wants(options, "cache"))
        keep(write_vertex_cache(files, head, report.correctives.rig, *report.animation,
                                folder.partial()));
    if (wants(options, "table"))
        keep(write_shape_table(files, head, report.shapes, folder.partial()));
    if (wants(options, "obj")) keep(write_shape_objs(files, head, report.shapes, folder.partial()));

    // What people look at
    std::optional<ShapesPictures> pictures;
    if (options.pictures) {
        pictures = draw_shapes(report, files, head, folder.partial(), part_of(watch, compared, 1));
        written.insert(written.end(), pictures->files.begin(), pictures->files.end());
    }
    write_text(folder.partial() / "index.html",
               shapes_page(report, pictures ? &*pictures : nullptr));
    Json json = report.json();
    json[kFilesKey] = written;
    write_text(folder.partial() / "results.json", json.dump(2) + "\n");
    folder.commit();
    return report;
}

}  // namespace risorius::app
