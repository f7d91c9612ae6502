// SPDX-License-Identifier: MIT
/// \file
/// The plan of one render. Everything that the run needs is read and checked before it begins.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "risorius/animate/render_inputs.h"
#include "risorius/animate/render_request.h"
#include "risorius/blendshapes/shape_player.h"
#include "risorius/face/quality.h"
#include "risorius/media/video_writer.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/talk/say_event.h"
#include "risorius/track/script.h"

namespace risorius::animate {

/// Blend shapes that play the script instead of the simulation.
struct ShapesInput {
    InputFile file;
    std::shared_ptr<const blendshapes::ShapesOfFile> content;
};

/// A complete plan of one render.
struct RenderJob {
    // Inputs
    InputFile script_file;
    /// The script as its file has it; changes by the request are in the fields below
    track::ScriptDescription script;
    std::shared_ptr<const RigInput> rig;
    std::vector<InputFile> recordings;  ///< recordings that the script names
    std::optional<ShapesInput> shapes;
    talk::PlannedSpeech speech;  ///< what the events "say" of the script make
    /// The script to compare with when "error" is shown
    std::optional<track::ScriptDescription> reference;

    // Frames
    int fps = 60, frames = 0;
    double first_frame_s = 0;     ///< 0 except for a still, a turntable and given times
    std::vector<double> times_s;  ///< times of the frames if they are not evenly spaced; else empty
    bool turntable = false;       ///< all frames show first_frame_s while the head makes one turn
    bool still = false;           ///< one picture instead of a video

    /// Motion blur: the shutter is open for shutter_deg / 360 of a frame, half of it before the frame's time. The picture is
    /// the mean, in linear light, of kShutterMoments moments at the midpoints of equal intervals. 0: the frame's time only.
    double shutter_deg = 0;
    static constexpr int kShutterMoments = 9;
    int moments() const { return shutter_deg > 0 ? kShutterMoments : 1; }
    /// Returns the offset of a moment from the time of its frame, in frames.
    double moment_offset(int moment) const {
        return shutter_deg / 360 * (moment - (moments() - 1) / 2) / moments();
    }
    double time_s(int frame) const {
        if (!times_s.empty()) return times_s[static_cast<std::size_t>(frame)];
        return turntable ? first_frame_s : first_frame_s + static_cast<double>(frame) / fps;
    }

    // Simulation and view
    face::Quality quality;
    render::ViewOptions view;
    std::optional<double> scale;  ///< end of the colour scale of strain (ratio) or error (mm)
    SyncMarks marks;
    bool flipped_motion = false;  ///< see RenderRequest
    int threads = 2;

    // Outputs
    std::filesystem::path out;
    std::filesystem::path passes_folder;
    std::vector<std::string> passes;    ///< names of pass_names()
    std::vector<std::string> warnings;  ///< what the output leaves out, for the record
    bool landmarks = false;             ///< whether the table has the positions of landmarks
    bool emg = false;                   ///< whether the table has simulated EMG
    media::VideoOptions video;

    double planning_s = 0;  ///< time that plan_render_job() took

    std::string background_text() const;  ///< the background as a script names it
};

/// Reads every input once, checks it and the request, and rejects what would otherwise fail after minutes of rendering. Only the
/// folder of passes is opened later, because it needs the face. Throws Error; the message names the option, or the file and the
/// place in it.
RenderJob plan_render_job(const RenderRequest& request);

/// Does the same with `inputs` that several jobs share, so that each file is read once.
RenderJob plan_render_job(const RenderRequest& request, RenderInputs& inputs);

}  // namespace risorius::animate
