// SPDX-License-Identifier: MIT
/// \file
/// One clip of a stimulus set: rendered, shown as its control wants it, and written with its ground truth.
///
///   stimuli/stim-NAME_video.mp4                  the pictures; with a recording it is stim-NAME_audiovideo.mp4
///   stimuli/stim-NAME_audio.wav                  the recording alone, as loud and as long as in the clip
///   stimuli/stim-NAME_annot-frames_events.tsv    a row for each frame as shown: onset and duration in s, source_frame, and the
///                                                columns of frame_table.h
///   stimuli/stim-NAME_video.json                 the sidecar: how the clip was made; it exists only when the clip is complete
///   overview/NAME.png                            five of its frames side by side
///   code/scripts/NAME.json                       the script as it was played; it is written for the reader, not read back
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "risorius/animate/render_inputs.h"
#include "risorius/animate/render_job.h"
#include "risorius/animate/render_session.h"
#include "risorius/core/json_cursor.h"
#include "risorius/design/conditions.h"
#include "risorius/design/design.h"
#include "risorius/media/tone.h"
#include "risorius/stimuli/detail/clip_sound.h"

namespace risorius::stimuli {

/// A clip that has been planned and checked, but not made.
struct ClipPlan {
    design::Condition condition;
    design::ClipOptions clips;
    std::string
        script_name;  ///< the path that stands for the script, which is in memory, in messages
    /// Given when pictures are matched in luminance; the clip is then made of an unmatched render (unmatched_render.h).
    std::optional<design::LuminanceMatch> luminance;
    std::optional<media::Tone> tone;  ///< known when the renders of all conditions are measured
    std::optional<ClipSound> sound;
    int frames = 0, fps = 0, width_px = 0, height_px = 0;
    std::array<std::uint8_t, 3> background{};  ///< sRGB, as it is shown
    std::string
        scene_sha256;  ///< of face and view; renders with the same value can share a session
    std::string render_sha256;  ///< of all that the pictures depend on before they are matched
    std::string
        content_sha256;  ///< of all that the clip depends on: the same value, the same bytes
    bool render_is_shared = false;     ///< by controls of the clip
    std::size_t condition_number = 0;  ///< of the clip's condition among all conditions
    double seconds() const;            ///< estimated time to make it, on two cores
    double megabytes() const;          ///< estimated
    bool is_control() const { return condition.control.kind != design::ControlKind::kNone; }
    void match(const media::Tone& matched);  ///< sets the tone; once, before the clip is made
};

/// Checks the script of a condition against its rig. Throws Error naming the condition.
ClipPlan plan_clip(const design::Condition& condition, const design::Design& design,
                   animate::RenderInputs& inputs, SoundPlans& sounds);

/// Whether `folder` holds this clip with all its files unchanged.
bool is_made(const ClipPlan& plan, const std::filesystem::path& folder);

/// The names of a clip's files below its folder.
struct ClipFiles {
    std::filesystem::path script, strip, video, events;
    std::filesystem::path sound;    ///< empty when there is none
    std::filesystem::path sidecar;  ///< written last: a clip that has it is complete
    /// All files but the sidecar, which lists them.
    std::vector<std::filesystem::path> listed() const;
};
ClipFiles clip_files(const ClipPlan& plan);

/// What one worker of a batch makes its clips with.
struct ClipWorker {
    const std::filesystem::path& folder;  ///< of the set
    int threads;                          ///< RenderRequest::threads
    int clips_at_once;                    ///< in this process
    animate::RenderInputs& inputs;        ///< shared by all workers
    animate::RenderSession& session;      ///< the worker's own
    const ProgressMonitor& monitor;
};

/// The job that renders a clip's script into the file `out`. The script is taken from the plan, in memory.
animate::RenderJob render_job_of(const ClipPlan& plan, const std::filesystem::path& out,
                                 const media::VideoOptions& coding, const ClipWorker& worker);
/// The record of a run without what differs from one run to the next and from one folder to another.
Json portable_record(const animate::RunRecord& record);
std::string text_of_file(const std::filesystem::path& file);

/// Throws Error, RunError and Interrupted. Then no new file has its final name, except files that the next attempt replaces.
void make_clip(const ClipPlan& plan, const ClipWorker& worker);

/// The sidecar of a clip that is made.
Json clip_record(const ClipPlan& plan, const std::filesystem::path& folder);

}  // namespace risorius::stimuli
