// SPDX-License-Identifier: MIT
#include "risorius/animate/landmark_run.h"

#include <algorithm>

#include "risorius/animate/detail/ready_face.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/track/timeline.h"

namespace risorius::animate {

namespace {

Points positions_mm(const scene::LandmarkPoints& landmarks, const std::vector<std::string>& ids,
                    const Points& vertices) {
    Points out(static_cast<Eigen::Index>(ids.size()), 3);
    for (std::size_t i = 0; i < ids.size(); ++i)
        out.row(static_cast<Eigen::Index>(i)) = 1e3 * landmarks.at(ids[i], vertices).transpose();
    return out;
}

/// How much a drive asks for: the sum of all excitations, and of the jaw in fractions of its way.
double effort(const track::Drive& drive) {
    double sum = drive.excitation.size() > 0 ? drive.excitation.cwiseAbs().sum() : 0.0;
    for (const double value : drive.activation)
        if (value > 0) sum += value;  // false for NaN: it follows the excitation
    return sum + std::abs(drive.at(track::Kinematic::kJawOpen));
}

bool moves_only_head_or_gaze(const std::string& channel) {
    return channel.starts_with("head_") || channel.starts_with("gaze_");
}

}  // namespace

LandmarkFrames play_landmarks(const RenderJob& job, RenderSession& session,
                              const ProgressMonitor& monitor) {
    face::Face& face = ready_face(job, session);
    const track::ChannelTable channels = job.rig->files.rig.channels();
    const track::Timeline timeline(job.script, channels);
    const auto drive = [&](double t_s) { return timeline.at(t_s); };
    const scene::LandmarkPoints landmarks(face.head(), job.rig->files.rig);
    LandmarkFrames out;
    out.ids = landmarks.ids();
    face.start(drive);
    for (int frame = 0; frame < job.frames; ++frame) {
        monitor.throw_if_stopped();
        face::FacePose pose = face.pose_at(job.time_s(frame), drive);
        if (job.flipped_motion) flip_motion(face.head().vertices, pose);
        out.positions_mm.push_back(positions_mm(landmarks, out.ids, pose.vertices));
    }
    return out;
}

LandmarkFrames settled_landmarks(const RenderJob& job, RenderSession& session) {
    face::Face& face = ready_face(job, session);
    const track::ChannelTable channels = job.rig->files.rig.channels();
    const track::Timeline timeline(job.script, channels);
    const scene::LandmarkPoints landmarks(face.head(), job.rig->files.rig);
    double strongest_s = job.time_s(0), most = -1;
    for (int frame = 0; frame < job.frames; ++frame)
        if (const double now = effort(timeline.at(job.time_s(frame))); now > most) {
            most = now;
            strongest_s = job.time_s(frame);
        }
    LandmarkFrames out;
    out.ids = landmarks.ids();
    for (const double t_s : {job.time_s(0), strongest_s}) {
        const track::Drive held = timeline.at(t_s);
        const auto drive = [&](double) { return held; };
        face.start(drive);
        face::FacePose pose = face.pose_at(0, drive);
        if (job.flipped_motion) flip_motion(face.head().vertices, pose);
        out.positions_mm.push_back(positions_mm(landmarks, out.ids, pose.vertices));
    }
    return out;
}

std::optional<RenderJob> job_without_expression(const RenderJob& job) {
    RenderJob out = job;
    track::ScriptDescription& script = out.script;
    std::erase_if(script.channels, [](const track::ChannelTrack& channel) {
        return !moves_only_head_or_gaze(channel.name);
    });
    if (script.channels.empty() && script.blinks.empty() && script.idle.empty() &&
        script.pulls.empty())
        return {};
    script.emg.clear();
    script.expressions.clear();
    script.says.clear();
    script.sources.clear();
    return out;
}

}  // namespace risorius::animate
