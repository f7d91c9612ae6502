// From a script to pictures: the function to read first.
#include "risorius/animate/film.h"

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>

#include "risorius/animate/detail/frame_table.h"
#include "risorius/animate/detail/marked_pictures.h"
#include "risorius/animate/detail/pipeline.h"
#include "risorius/animate/detail/reference_run.h"
#include "risorius/blendshapes/shape_player.h"
#include "risorius/face/face.h"
#include "risorius/media/sha256.h"
#include "risorius/render/gl_choice.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/report/stopwatch.h"
#include "risorius/scene/rig_files.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/scene/script_drives.h"
#include "risorius/scene/visualization.h"
#include "risorius/track/simulated_emg.h"
#include "risorius/track/timeline.h"

namespace risorius::animate {

namespace fs = std::filesystem;

namespace {

/// More views than this wait for the simulation.
constexpr int kMostViews = 4;

// A jaw that follows its channels does so whatever the muscles that would move it do.
std::vector<std::string> warnings_about(const track::ScriptDescription& script,
                                        const rig::MuscleTable& muscles) {
    std::vector<std::string> out;
    if (script.header.jaw == track::JawDrive::kMuscles) return out;
    for (const track::ChannelTrack& channel : script.channels)
        for (const rig::Muscle& muscle : muscles.muscles)
            if (muscle.id == track::split_side(channel.name).id &&
                (muscle.group == "jaw" || muscle.group == "hyoid"))
                out.push_back("channel " + channel.name +
                              ": does not move the jaw, which follows jaw_open, jaw_forward and "
                              "jaw_side unless the script says \"jaw\": \"muscles\"");
    return out;
}

RunRecord describe(const AnimateOptions& options, const Shot& shot,
                   const track::ScriptDescription& script, const scene::RigFiles& files,
                   const face::Face& face) {
    RunRecord record;
    record.script = {options.script, media::sha256_of_file(options.script)};
    for (const fs::path& recording : script.recordings)
        record.recordings.push_back({recording, media::sha256_of_file(recording)});
    record.rig = {files.file, media::sha256_of_file(files.file)};
    record.mesh = {files.rig.mesh_file, media::sha256_of_file(files.rig.mesh_file)};
    if (options.shapes) record.shapes = {*options.shapes, media::sha256_of_file(*options.shapes)};
    for (const fs::path& table : files.rig.table_files)
        record.tables.push_back({table, media::sha256_of_file(table)});
    record.out = options.out;
    record.seed = shot.script.seed;
    record.fps = shot.script.fps;
    record.frames = shot.frames;
    record.first_frame_s = shot.first_s;
    record.width_px = shot.view.width_px;
    record.height_px = shot.view.height_px;
    record.camera = shot.view.camera;
    record.shutter_deg = shot.shutter_deg;
    record.shutter_moments = shot.moments();
    if (shot.view.show == render::Show::kStrain || shot.view.show == render::Show::kError)
        record.scale_to = scene::Visualization::scale_end(shot.view.show, options.scale);
    record.show = render::show_names()[static_cast<std::size_t>(shot.view.show)];
    record.background = shot.background_text();
    record.quality = quality_of(options);
    record.antialiasing = shot.view.supersampling;
    record.graphics = render::gl_in_use();
    record.jaw = script.header.jaw == track::JawDrive::kMuscles ? "muscles" : "channels";
    record.nodes = face.node_count();
    record.tets = face.tet_count();
    record.dropped_tets = face.dropped_tets();
    record.fibres = face.fibre_count();
    return record;
}

/// In face, eyes and mouth, when masks are wanted.
std::array<double, 3> luminance_within(const std::optional<PassWriter>& passes,
                                       const Image& image) {
    if (!passes) return {};
    const PassWriter::Masks& masks = passes->masks();
    return {media::mean_luminance(image, masks.face), media::mean_luminance(image, masks.eyes),
            media::mean_luminance(image, masks.mouth)};
}

/// The whole head turned about the vertical axis, to its left.
face::FacePose turned(face::FacePose pose, double angle_rad) {
    const Mat3 turn(Eigen::AngleAxisd(angle_rad, Vec3::UnitY()));
    pose.vertices *= turn.transpose();
    for (Mat3& eye : pose.eye_rotation) eye = turn * eye;
    pose.head = turn * pose.head;
    return pose;
}

/// Every vertex as far below where it is at rest as it was above.
void flip_motion(const Points& rest, face::FacePose& pose) {
    pose.vertices.col(1) = 2 * rest.col(1) - pose.vertices.col(1);
}

}  // namespace

RunRecord film(const AnimateOptions& options, const Shot& shot, const UsePicture& use,
               FilmExtras& extras, const ProgressMonitor& monitor) {
    Studio studio;
    return film(options, shot, use, extras, monitor, studio);
}

RunRecord film(const AnimateOptions& options, const Shot& shot, const UsePicture& use,
               FilmExtras& extras, const ProgressMonitor& monitor, Studio& studio) {
    const report::Stopwatch total;

    // Read what was asked for
    const face::Quality quality = face::quality_named(quality_of(options));
    const scene::RigFiles& files = studio.rig(shot.script.rig_file);
    const track::ChannelTable channels = files.rig.channels();
    const track::ScriptDescription script =
        track::read_script(options.script, channels, files.rig.facs, files.rig.expressions);

    // Build what runs
    monitor.report(0, "building the face");
    face::Face& face = studio.face(quality);
    face.drive_jaw_by(script.header.jaw);
    face.set_gravity(script.header.gravity_m_s2);
    face.move(script.header.motion == track::Motion::kDynamic ? face::Motion::kDynamic
                                                              : face::Motion::kQuasiStatic);
    const track::Timeline timeline(script, channels);
    std::optional<blendshapes::ShapePlayer> shapes;
    scene::ScriptDrives script_drives(script, files.rig);
    if (options.shapes)
        shapes.emplace(blendshapes::read_shapes_of_file(*options.shapes, files, face.head()), face,
                       channels);
    const bool inside = shot.view.show == render::Show::kMuscles;
    const int workers =
        options.threads > 1 ? std::min({options.threads, kMostViews, shot.frames}) : 0;
    const render::Scene& scene = studio.scene(shot.view, std::max(workers, 1));
    const render::OffscreenView& view = studio.view();
    const scene::LandmarkPoints landmarks(face.head(), files.rig);
    const scene::Visualization sight(shot.view.show, scene, face.head(), files.mesh, view,
                                     shot.view.width_px, shot.view.height_px, landmarks,
                                     options.scale);
    std::optional<ReferenceRun> reference;
    if (options.against)
        reference.emplace(*options.against, shot.script.rig_file, quality_of(options),
                          scene.rest.rows());
    RunRecord record = describe(options, shot, script, files, face);
    record.warnings = warnings_about(script, files.rig.muscles);
    record.timing.build_s = total.seconds();

    // One picture per frame
    const auto drive = [&](double t_s) { return timeline.at(t_s); };
    FrameTableOptions columns{.landmarks = options.landmarks,
                              .project = [&](const Vec3& world) { return view.project(world); },
                              .emg = {}};
    for (std::size_t side = 0; side < 2; ++side)
        columns.eye_forward[side] = face.head().eyes[side].forward;
    columns.masks =
        std::find(options.passes.begin(), options.passes.end(), "masks") != options.passes.end();
    columns.photodiode = options.marks.photodiode.has_value();
    const auto driven = [&](double t_s) { return face.driven(timeline.at(t_s)); };
    track::SimulatedEmg emg(channels, driven);
    if (options.emg) columns.emg = [&](double t_s) { return emg.at(t_s); };
    FrameTable table(channels, landmarks, track::UnitIntensity(script, files.rig.facs),
                     std::move(columns));
    MarkedPictures pictures(options.marks, script, shot.script.fps);
    std::optional<PassWriter>& passes = extras.passes;
    if (!options.passes.empty())
        passes.emplace(extras.passes_folder, options.passes, scene, view.clip_from_world(),
                       shot.view.width_px, shot.view.height_px, landmarks);
    media::Sha256 hash;
    int most_inverted_tets = 0;
    // Of a shutter's moments the middle one is the frame's own time, of which the table tells.
    const auto simulate_moment = [&](int frame, int moment) {
        const double offset = shot.moment_offset(moment);
        const double t_s = shot.still_time
                               ? shot.first_s
                               : std::max(0.0, shot.time_s(frame) + offset / shot.script.fps);
        if (frame == 0 && moment == 0 && !shapes) face.start(drive);
        while (!shapes && script.header.motion == track::Motion::kDynamic &&
               face.time_s() + 2 * face.step_s() < t_s) {  // what leads up to a still
            monitor.report(face.time_s() / t_s, "simulating");
            face.step(drive);
        }
        std::optional<track::Drive> played;
        if (shapes) played = script_drives.at(t_s);
        face::FacePose pose = shapes ? shapes->pose(*played) : face.pose_at(t_s, drive);
        if (shapes) face.fold(pose, *played);
        if (options.flipped_motion) flip_motion(face.head().vertices, pose);
        const double angle_rad =
            options.turntable_s ? 2 * std::numbers::pi * (frame + offset) / shot.frames : 0.0;
        if (options.turntable_s) pose = turned(std::move(pose), angle_rad);
        const Eigen::VectorXd activation = shapes ? played->excitation : face.activation_at(t_s);
        if (moment == shot.moments() / 2) table.add(frame, t_s, driven(t_s), activation, pose);
        record.widest_jaw_mm = std::max(record.widest_jaw_mm, 1e3 * pose.jaw.open_m);
        record.greatest_bite_n = std::max(record.greatest_bite_n, pose.tooth_force_n);
        if (!shapes) most_inverted_tets = std::max(most_inverted_tets, face.inverted_tets());
        render::Pose seen = scene::pose_for_view(pose);
        if (inside) {
            Points muscles = face.muscle_vertices_at(t_s);
            if (options.turntable_s)
                muscles *= Mat3(Eigen::AngleAxisd(angle_rad, Vec3::UnitY())).transpose();
            scene::add_muscles(face.muscle_surfaces(), activation, std::move(muscles), seen);
        }
        if (const auto& skull = studio.skull()) scene::add_bones(*skull, pose, seen);
        seen.values = sight.values(pose.vertices,
                                   reference ? std::optional(reference->at(t_s)) : std::nullopt);
        return seen;
    };
    const auto simulate = [&](int frame) {
        const report::Stopwatch stage;
        std::vector<render::Pose> poses;
        for (int moment = 0; moment < shot.moments(); ++moment)
            poses.push_back(simulate_moment(frame, moment));
        record.timing.simulate_s += stage.seconds();
        return poses;
    };
    struct Drawn {
        Points positions;
        Image image;
        double draw_s;
    };
    const auto draw = [&](int worker, int /*frame*/, std::vector<render::Pose> poses) {
        const report::Stopwatch drawing;
        Image image = studio.view(worker).draw(poses);
        return Drawn{std::move(poses[poses.size() / 2].positions), std::move(image),
                     drawing.seconds()};
    };
    const auto show = [&](int frame, Drawn drawn) {
        monitor.report(static_cast<double>(frame) / shot.frames, kRendering);
        const report::Stopwatch marking;
        Image& image = drawn.image;
        sight.draw_over(drawn.positions, image);
        if (passes) passes->add(frame, drawn.positions);
        table.add_picture(pictures.measure(image), luminance_within(passes, image),
                          pictures.lit(frame));
        pictures.mark(frame, image);
        hash.add(image.rgba.data(), image.rgba.size());
        record.timing.draw_s += drawn.draw_s + marking.seconds();
        const report::Stopwatch encoding;
        use(std::move(image));
        record.timing.encode_s += encoding.seconds();
    };
    run_pipeline(shot.frames, workers, simulate, draw, show);

    record.frames_sha256 = hash.finish();
    record.solver = solver_figures(face.history(), most_inverted_tets);
    record.timing.threads = options.threads;
    record.timing.total_s = total.seconds();
    extras.table = table.text();
    return record;
}

}  // namespace risorius::animate
