#include "app/animate.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/frame_table.h"
#include "app/marked_pictures.h"
#include "app/pass_writer.h"
#include "app/rig_files.h"
#include "app/scene_from_rig.h"
#include "app/shot.h"
#include "app/staged_file.h"
#include "app/stopwatch.h"
#include "app/two_stages.h"
#include "media/image_file.h"
#include "media/sha256.h"
#include "media/video_writer.h"
#include "render/offscreen_view.h"
#include "sim/face.h"
#include "track/simulated_emg.h"
#include "track/timeline.h"

namespace risorius::app {

namespace fs = std::filesystem;

namespace {

// A video, or for a still a single picture.
class Output {
  public:
    Output(const fs::path& out, const Shot& shot, bool still) : out_(out) {
        if (!still) video_.emplace(out, shot.video);
    }
    void append(Image image) {
        if (video_)
            video_->append(image);
        else
            still_ = std::move(image);
    }
    void finish() {
        if (video_)
            video_->finish();
        else
            media::write_png(still_, out_);
    }

  private:
    fs::path out_;
    std::optional<media::VideoWriter> video_;
    Image still_;
};

// "hello.mp4" -> "hello.mp4.json", "frames/" -> "frames.json"
fs::path beside(const fs::path& out, const char* ending) {
    fs::path base = out.has_filename() ? out : out.parent_path();
    base += ending;
    return base;
}

// A script named like the record would be lost under it.
void check_beside(const fs::path& out) {
    const fs::path record = beside(out, ".json"), table = beside(out, ".frames.tsv");
    if (fs::exists(record)) {
        const Json found = Json::parse(std::ifstream(record), nullptr, false);
        if (!found.is_object() || found.value("format", "") != "risorius-run")
            throw Error(record.string(), "no file, or the record of an earlier run",
                        "another file of that name");
    }
    if (fs::exists(table)) {
        std::string first;
        std::getline(std::ifstream(table), first);
        if (!first.starts_with("frame\ttime_s"))
            throw Error(table.string(), "no file, or the table of an earlier run",
                        "another file of that name");
    }
}

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
                   const track::ScriptDescription& script, const RigFiles& files,
                   const sim::Face& face) {
    RunRecord record;
    record.script = {options.script, media::sha256_of_file(options.script)};
    for (const fs::path& recording : script.recordings)
        record.recordings.push_back({recording, media::sha256_of_file(recording)});
    record.rig = {files.file, media::sha256_of_file(files.file)};
    record.mesh = {files.rig.mesh_file, media::sha256_of_file(files.rig.mesh_file)};
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
    record.show = render::show_names()[static_cast<std::size_t>(shot.view.show)];
    record.background = shot.background_text();
    record.quality = options.quality;
    record.jaw = script.header.jaw == track::JawDrive::kMuscles ? "muscles" : "channels";
    record.nodes = face.node_count();
    record.tets = face.tet_count();
    record.dropped_tets = face.dropped_tets();
    record.fibres = face.fibre_count();
    return record;
}

}  // namespace

RunRecord animate(const AnimateOptions& options, const Watch& watch) {
    const Stopwatch total;

    // Read what was asked for
    const Shot shot = plan_shot(options);
    check_beside(options.out);
    const sim::Quality quality = sim::quality_named(options.quality);
    const RigFiles files = read_rig_files(shot.script.rig_file);
    const track::ChannelTable channels = files.rig.channels();
    const track::ScriptDescription script =
        track::read_script(options.script, channels, files.rig.facs, files.rig.expressions);

    // Build what runs
    watch.tell(0, "building the face");
    sim::Face face(files.rig, files.mesh, quality, files.place());
    face.drive_jaw_by(script.header.jaw);
    face.set_gravity(script.header.gravity_m_s2);
    face.move(script.header.motion == track::Motion::kDynamic ? sim::Motion::kDynamic
                                                              : sim::Motion::kQuasiStatic);
    const track::Timeline timeline(script, channels);
    render::Scene scene = scene_from_rig(face.head(), files.rig, files.mesh);
    add_wrinkles(face.wrinkle_lines(), scene);
    const bool inside = shot.view.show == render::Show::kMuscles;
    if (inside) scene.muscles = muscles_for_view(face.muscle_surfaces());
    render::OffscreenView view(scene, shot.view);
    Output output(options.out, shot, options.still_s.has_value());
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
    columns.photodiode = options.marks.photodiode.has_value();
    const auto driven = [&](double t_s) { return face.driven(timeline.at(t_s)); };
    track::SimulatedEmg emg(channels, driven);
    if (options.emg) columns.emg = [&](double t_s) { return emg.at(t_s); };
    FrameTable table(channels, LandmarkPoints(face.head(), files.rig),
                     track::UnitIntensity(script, files.rig.facs), std::move(columns));
    MarkedPictures pictures(options.marks, script, shot.script.fps);
    std::optional<PassWriter> passes;
    if (!options.passes.empty())
        passes.emplace(beside(options.out, ".passes"), options.passes, scene,
                       view.clip_from_world(), shot.view.width_px, shot.view.height_px,
                       LandmarkPoints(face.head(), files.rig));
    media::Sha256 hash;
    int most_inverted_tets = 0;
    const auto simulate = [&](int frame) {
        const Stopwatch stage;
        const double t_s = shot.time_s(frame);
        if (frame == 0) face.start(drive);
        while (script.header.motion == track::Motion::kDynamic &&
               face.time_s() + 2 * face.step_s() < t_s) {  // what leads up to a still
            watch.tell(face.time_s() / t_s, "simulating");
            face.step(drive);
        }
        const sim::FacePose pose = face.pose_at(t_s, drive);
        const Eigen::VectorXd activation = face.activation_at(t_s);
        table.add(frame, t_s, driven(t_s), activation, pose);
        record.widest_jaw_mm = std::max(record.widest_jaw_mm, 1e3 * pose.jaw.open_m);
        record.greatest_bite_n = std::max(record.greatest_bite_n, pose.tooth_force_n);
        most_inverted_tets = std::max(most_inverted_tets, face.inverted_tets());
        render::Pose seen = pose_for_view(pose);
        if (inside)
            add_muscles(face.muscle_surfaces(), activation, face.muscle_vertices_at(t_s), seen);
        record.timing.simulate_s += stage.seconds();
        return seen;
    };
    const auto show = [&](int frame, const render::Pose& pose) {
        watch.tell(static_cast<double>(frame) / shot.frames, "rendering");
        const Stopwatch drawing;
        Image image = view.draw(pose);
        table.add_picture(pictures.measure(image), pictures.lit(frame));
        pictures.mark(frame, image);
        if (passes) passes->add(frame, pose.positions);
        hash.add(image.rgba.data(), image.rgba.size());
        record.timing.draw_s += drawing.seconds();
        const Stopwatch encoding;
        output.append(std::move(image));
        record.timing.encode_s += encoding.seconds();
    };
    in_two_stages(shot.frames, options.threads, simulate, show);

    // Leave everything or nothing
    record.frames_sha256 = hash.finish();
    record.solver = solver_figures(face.history(), most_inverted_tets);
    record.timing.threads = options.threads;
    StagedFile frame_table(beside(options.out, ".frames.tsv"), table.text());
    const Stopwatch closing;
    output.finish();
    if (passes) passes->commit();
    record.timing.encode_s += closing.seconds();
    record.timing.total_s = total.seconds();
    write_text(beside(options.out, ".json"), record.json().dump(2) + "\n");
    frame_table.commit();
    watch.tell(1, "done");
    return record;
}

}  // namespace risorius::app
