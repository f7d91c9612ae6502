// SPDX-License-Identifier: MIT
// From a job to pictures. Start reading here: JobRun::run() is the loop over the frames.
#include "risorius/animate/run_render_job.h"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>

#include "risorius/animate/detail/frame_table.h"
#include "risorius/animate/detail/marked_pictures.h"
#include "risorius/animate/detail/pipeline.h"
#include "risorius/animate/detail/ready_face.h"
#include "risorius/animate/detail/reference_run.h"
#include "risorius/blendshapes/shape_player.h"
#include "risorius/core/error.h"
#include "risorius/core/sha256.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/face/surfaces.h"
#include "risorius/render/gl_choice.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/report/stopwatch.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/scene/script_drives.h"
#include "risorius/scene/visualization.h"
#include "risorius/talk/speech_columns.h"
#include "risorius/track/simulated_emg.h"
#include "risorius/track/timeline.h"

namespace risorius::animate {

namespace {

/// More views would only wait for the simulation
constexpr int kMaxViews = 4;

// Warns about muscles of the jaw, which have no effect while channels move it.
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

/// The part of the record that is known before the first frame.
RunRecord describe(const RenderJob& job, const face::Face& face) {
    RunRecord record;
    record.script = job.script_file;
    record.recordings = job.recordings;
    record.rig = job.rig->rig;
    record.mesh = job.rig->mesh;
    if (job.shapes) record.shapes = job.shapes->file;
    record.tables = job.rig->tables;
    record.out = job.out;
    record.seed = job.script.header.seed;
    record.fps = job.fps;
    record.frames = job.frames;
    record.first_frame_s = job.first_frame_s;
    record.width_px = job.view.width_px;
    record.height_px = job.view.height_px;
    record.camera = job.view.camera;
    record.shutter_deg = job.shutter_deg;
    record.shutter_moments = job.moments();
    if (job.view.show == render::Show::kStrain || job.view.show == render::Show::kError)
        record.scale_to = scene::Visualization::scale_end(job.view.show, job.scale);
    record.show = render::show_names()[static_cast<std::size_t>(job.view.show)];
    record.background = job.background_text();
    record.quality = job.quality.name;
    record.step_s = job.quality.step_s;
    record.antialiasing = job.view.supersampling;
    record.graphics = render::gl_in_use();
    record.jaw = job.script.header.jaw == track::JawDrive::kMuscles ? "muscles" : "channels";
    record.nodes = face.diagnostics().node_count();
    record.tets = face.diagnostics().tet_count();
    record.dropped_tets = face.diagnostics().dropped_tets();
    record.fibres = face.diagnostics().fibre_count();
    record.warnings = warnings_about(job.script, job.rig->files.rig.muscles);
    record.warnings.insert(record.warnings.end(), job.warnings.begin(), job.warnings.end());
    record.timing.threads = job.threads;
    return record;
}

/// Mean luminance within the masks of face, eyes and mouth; zeros when no passes are written.
std::array<double, 3> luminance_within(const PassWriter* passes, const Image& image) {
    if (!passes) return {};
    const PassWriter::Masks& masks = passes->masks();
    return {media::mean_luminance(image, masks.face), media::mean_luminance(image, masks.eyes),
            media::mean_luminance(image, masks.mouth)};
}

/// The pose with the whole head turned about the vertical axis, to its left.
face::FacePose turned(face::FacePose pose, double angle_rad) {
    const Mat3 turn(Eigen::AngleAxisd(angle_rad, Vec3::UnitY()));
    pose.vertices *= turn.transpose();
    for (Mat3& eye : pose.eye_rotation) eye = turn * eye;
    pose.head = turn * pose.head;
    return pose;
}

std::optional<blendshapes::ShapePlayer> player_of(const RenderJob& job, face::Face& face,
                                                  const track::ChannelTable& channels) {
    if (!job.shapes) return {};
    return std::optional<blendshapes::ShapePlayer>(std::in_place, *job.shapes->content, face,
                                                   channels);
}

/// One run of a job. Each frame passes simulate(), draw() and show(). These run on different threads and share no mutable
/// members.
class JobRun {
  public:
    JobRun(const RenderJob& job, RenderSession& session, const UsePicture& use,
           const ProgressMonitor& monitor)
        : job_(job),
          session_(session),
          use_(use),
          monitor_(monitor),
          channels_(job.rig->files.rig.channels()),
          face_(ready_face(job, session)),
          timeline_(job.script, channels_),
          script_drives_(job.script, job.rig->files.rig),
          shapes_(player_of(job, face_, channels_)),
          workers_(job.threads > 1 ? std::min({job.threads, kMaxViews, job.frames}) : 0),
          scene_(session.scene(job.view, std::max(workers_, 1))),
          view_(session.view()),
          landmarks_(face_.head(), job.rig->files.rig),
          visualization_(job.view.show, scene_, face_.head(), job.rig->files.mesh, view_,
                         job.view.width_px, job.view.height_px, landmarks_, job.scale),
          emg_(channels_, [this](double t_s) { return driven(t_s); }),
          table_(channels_, landmarks_, track::UnitIntensity(job.script, job.rig->files.rig.facs),
                 table_columns()),
          pictures_(job.marks, job.script, job.fps) {
        if (job.reference) reference_.emplace(*job.reference, job.rig->files, job.quality);
        result_.record = describe(job, face_);
        if (!job.passes.empty())
            result_.passes = std::make_unique<PassWriter>(
                job.passes_folder, job.passes, scene_, view_.clip_from_world(), job.view.width_px,
                job.view.height_px, landmarks_);
    }

    RenderResult run() {
        RunRecord& record = result_.record;
        record.timing.build_s = job_.planning_s + total_.seconds();
        run_pipeline(
            job_.frames, workers_, [this](int frame) { return simulate(frame); },
            [this](int worker, int /*frame*/, std::vector<render::Pose> poses) {
                return draw(worker, std::move(poses));
            },
            [this](int frame, Drawn drawn) { show(frame, std::move(drawn)); });
        record.frames_sha256 = hash_.finish();
        record.solver = solver_stats(face_.diagnostics().history(), max_inverted_tets_);
        record.timing.total_s = job_.planning_s + total_.seconds();
        result_.table = table_.text();
        return std::move(result_);
    }

  private:
    struct Drawn {
        Points positions;
        Image image;
        double draw_s;
    };

    track::Drive driven(double t_s) const { return face_.diagnostics().driven(timeline_.at(t_s)); }

    FrameTableOptions table_columns() {
        FrameTableOptions columns{
            .landmarks = job_.landmarks,
            .project = [this](const Vec3& world) { return view_.project(world); },
            .emg = {}};
        for (std::size_t side = 0; side < 2; ++side)
            columns.eye_forward[side] = face_.head().eyes[side].forward;
        columns.masks =
            std::find(job_.passes.begin(), job_.passes.end(), "masks") != job_.passes.end();
        columns.photodiode = job_.marks.photodiode.has_value();
        if (!job_.speech.utterances.empty()) {
            speech_.emplace(job_.speech.utterances, face_.head(), job_.rig->files.rig);
            columns.speech_names = talk::SpeechColumns::names();
            columns.speech = [this](double t_s, const face::FacePose& pose) {
                return speech_->cells(t_s, pose);
            };
        }
        if (job_.emg) columns.emg = [this](double t_s) { return emg_.at(t_s); };
        return columns;
    }

    /// The poses of all moments of a frame.
    std::vector<render::Pose> simulate(int frame) {
        const report::Stopwatch stage;
        std::vector<render::Pose> poses;
        for (int moment = 0; moment < job_.moments(); ++moment)
            poses.push_back(simulate_moment(frame, moment));
        result_.record.timing.simulate_s += stage.seconds();
        return poses;
    }

    render::Pose simulate_moment(int frame, int moment) {
        const double offset = job_.moment_offset(moment);
        const double t_s = job_.turntable ? job_.first_frame_s
                                          : std::max(0.0, job_.time_s(frame) + offset / job_.fps);
        std::optional<track::Drive> played;
        if (shapes_)
            played = script_drives_.at(t_s);
        else
            simulate_until(t_s, frame == 0 && moment == 0);
        face::FacePose pose = shapes_ ? shapes_->pose(*played) : face_.pose_at(t_s, drive_);
        if (shapes_) face_.surfaces().fold(pose, *played);
        if (job_.flipped_motion) flip_motion(face_.head().vertices, pose);
        const double angle_rad =
            job_.turntable ? 2 * std::numbers::pi * (frame + offset) / job_.frames : 0.0;
        if (job_.turntable) pose = turned(std::move(pose), angle_rad);
        const Eigen::VectorXd activation = shapes_ ? played->excitation : face_.activation_at(t_s);
        // The table has the middle moment, which is the time of the frame.
        if (moment == job_.moments() / 2) table_.add(frame, t_s, driven(t_s), activation, pose);
        RunRecord& record = result_.record;
        record.max_jaw_opening_mm = std::max(record.max_jaw_opening_mm, 1e3 * pose.jaw.open_m);
        record.max_tooth_force_n = std::max(record.max_tooth_force_n, pose.tooth_force_n);
        if (!shapes_)
            max_inverted_tets_ = std::max(max_inverted_tets_, face_.diagnostics().inverted_tets());
        return seen(pose, activation, t_s, angle_rad);
    }

    /// Steps the face until pose_at(t_s) has at most two steps to make. For a still this simulates everything before it.
    void simulate_until(double t_s, bool first) {
        if (first) face_.start(drive_);
        while (job_.script.header.motion == track::Motion::kDynamic &&
               face_.time_s() + 2 * face_.step_s() < t_s) {
            monitor_.report(face_.time_s() / t_s, "simulating");
            face_.step(drive_);
        }
    }

    /// The pose for the view, with muscles, bones and colours.
    render::Pose seen(const face::FacePose& pose, const Eigen::VectorXd& activation, double t_s,
                      double angle_rad) {
        render::Pose out = scene::pose_for_view(pose);
        if (job_.view.show == render::Show::kMuscles) {
            Points muscles = face_.surfaces().muscle_vertices_at(t_s);
            if (job_.turntable)
                muscles *= Mat3(Eigen::AngleAxisd(angle_rad, Vec3::UnitY())).transpose();
            scene::add_muscles(face_.surfaces().muscles(), activation, std::move(muscles), out);
        }
        if (const auto& skull = session_.skull()) scene::add_bones(*skull, pose, out);
        out.values = visualization_.values(
            pose.vertices, reference_ ? std::optional(reference_->at(t_s)) : std::nullopt);
        return out;
    }

    Drawn draw(int worker, std::vector<render::Pose> poses) {
        const report::Stopwatch drawing;
        Image image = session_.view(worker).draw(poses);
        return Drawn{std::move(poses[poses.size() / 2].positions), std::move(image),
                     drawing.seconds()};
    }

    /// Measures and marks one picture and passes it on.
    void show(int frame, Drawn drawn) {
        monitor_.report(static_cast<double>(frame) / job_.frames, kRendering);
        RunTiming& timing = result_.record.timing;
        const report::Stopwatch marking;
        Image& image = drawn.image;
        visualization_.draw_over(drawn.positions, image);
        PassWriter* passes = result_.passes.get();
        if (passes) passes->add(frame, drawn.positions);
        table_.add_picture(pictures_.measure(image), luminance_within(passes, image),
                           pictures_.lit(frame));
        pictures_.mark(frame, image);
        hash_.add(image.rgba.data(), image.rgba.size());
        timing.draw_s += drawn.draw_s + marking.seconds();
        const report::Stopwatch encoding;
        use_(std::move(image));
        timing.encode_s += encoding.seconds();
    }

    const report::Stopwatch total_;
    const RenderJob& job_;
    RenderSession& session_;
    const UsePicture& use_;
    const ProgressMonitor& monitor_;
    const track::ChannelTable channels_;
    face::Face& face_;
    const track::Timeline timeline_;
    const std::function<track::Drive(double)> drive_ = [this](double t_s) {
        return timeline_.at(t_s);
    };
    scene::ScriptDrives script_drives_;
    const std::optional<blendshapes::ShapePlayer> shapes_;
    const int workers_;
    const render::Scene& scene_;
    const render::OffscreenView& view_;
    const scene::LandmarkPoints landmarks_;
    const scene::Visualization visualization_;
    std::optional<ReferenceRun> reference_;
    track::SimulatedEmg emg_;
    std::optional<talk::SpeechColumns> speech_;
    FrameTable table_;
    MarkedPictures pictures_;
    Sha256 hash_;
    int max_inverted_tets_ = 0;
    RenderResult result_;
};

}  // namespace

RenderResult run_render_job(const RenderJob& job, RenderSession& session, const UsePicture& use,
                            const ProgressMonitor& monitor) {
    monitor.report(0, "building the face");
    JobRun run(job, session, use, monitor);
    return run.run();
}

}  // namespace risorius::animate
