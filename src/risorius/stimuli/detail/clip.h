// SPDX-License-Identifier: MIT
/// \file
/// One clip of a stimulus set: it is rendered, changed as its control requires, and written with its ground truth.
///
///   stimuli/stim-NAME_video.mp4                  the pictures; with a recording it is stim-NAME_audiovideo.mp4
///   stimuli/stim-NAME_image.png                  in a set of pictures: the picture in place of a video
///   stimuli/stim-NAME_audio.wav                  the recording alone, with the loudness and duration that it has in the clip
///   stimuli/stim-NAME_annot-frames_events.tsv    a row for each frame as shown: onset and duration in s, source_frame, and the
///                                                columns of frame_table.h
///   stimuli/stim-NAME_annot-frames_events.json   what each column of that table is
///   stimuli/stim-NAME_video.json                 the sidecar: how the clip was made; it exists only when the clip is complete
///   stimuli/stim-NAME_annot-aois_events.tsv      areas of interest, with their .json, aois/NAME_tobii.json and aois/NAME.ias; see aois.h
///   overview/NAME.png                            five of its frames side by side
///   code/scripts/NAME_lower.json                 of a chimeric clip: the script of its lower half
///   code/scripts/NAME.json                       the script as it was played; it is written for the reader, not read back
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "risorius/animate/render_inputs.h"
#include "risorius/animate/render_job.h"
#include "risorius/animate/render_session.h"
#include "risorius/core/json_cursor.h"
#include "risorius/design/conditions.h"
#include "risorius/design/design.h"
#include "risorius/media/luminance_map.h"
#include "risorius/media/tone.h"
#include "risorius/stimuli/detail/clip_sound.h"

namespace risorius::stimuli {

/// What a clip gets when histograms or spectra are matched, and what that aims at.
struct MappedLuminance {
    media::LuminanceMap map;
    std::vector<double> target;      ///< quantile function of luminance
    std::vector<double> amplitudes;  ///< by cycles per picture; empty: only the histogram
};

/// A larger set has its clips in folders of so many each, so that no folder has more than a thousand files.
inline constexpr std::size_t kClipsPerFolder = 200;

/// Returns "b012/" for the clips 2400 to 2599.
std::string folder_of_clips(std::size_t index);
/// Whether it is the name of such a folder.
bool is_folder_of_clips(const std::string& name);

/// A clip that has been planned and checked, but not made.
struct ClipPlan {
    design::Condition condition;
    std::string design;  ///< name of the design
    design::ClipOptions clips;
    /// Of a set with more than kClipsPerFolder clips: the folder of its files, "b012/", below stimuli, overview, aois and code/scripts
    std::string folder;
    /// Path that names the script in messages; the script itself is in memory
    std::string script_name;
    /// Given when luminance is matched; the clip is then made from an unmatched render (unmatched_render.h).
    std::optional<design::LuminanceMatch> luminance;
    /// Map of luminance; it is set when the renders of all conditions have been measured
    std::optional<media::Tone> tone;
    /// In place of the tone when histograms or spectra are matched
    std::shared_ptr<const MappedLuminance> mapped;
    std::optional<ClipSound> sound;
    /// Of a chimeric clip: the plan of what its lower half shows
    std::shared_ptr<const ClipPlan> lower;
    int frames = 0, fps = 0, width_px = 0, height_px = 0;  ///< a picture has one frame
    int script_frames = 0;                                 ///< frames that the script lasts
    /// Frames at the beginning that show the first one, because a recording of the set begins before the script; part of `frames`
    int lead_frames = 0;
    std::array<std::uint8_t, 3> background{};  ///< sRGB of the displayed background
    bool transparent = false;                  ///< whether there is none
    /// Checksum of face and view; clips with the same value can share a session
    std::string scene_sha256;
    std::string render_sha256;  ///< checksum of everything that the unmatched pictures depend on
    /// Checksum of everything that the clip depends on: equal values mean equal bytes
    std::string content_sha256;
    bool render_is_shared = false;     ///< whether controls of the clip use the same render
    std::size_t condition_number = 0;  ///< index of the clip's condition among all conditions
    std::string shown_sha256() const;  ///< of what a participant sees and hears, before matching
    double duration_s() const;         ///< how long it is shown
    double seconds() const;            ///< estimated time to make it on two cores
    double megabytes() const;          ///< estimated
    /// Frames of the film for each shown frame; more than one for controls that change the speed
    int finer() const;
    bool has_aois() const;  ///< whether areas of interest are asked for, and it shows them
    bool is_control() const { return condition.control.kind != design::ControlKind::kNone; }
    /// Sets the tone; call it once, before the clip is made
    void match(const media::Tone& matched);
};

class ClipChecks;

/// What the clips of a design share while they are planned.
struct PlanShared {
    const design::Design& design;
    animate::RenderInputs& inputs;
    SoundPlans& sounds;
    ClipChecks& checks;
};

/// Checks the script of a condition against its rig, and everything that would stop the clip later. `lead_s`: how long before the script
/// the earliest recording of the set begins. Throws Error naming the condition.
ClipPlan plan_clip(design::Condition condition, double lead_s, const PlanShared& shared);

/// Returns whether `folder` holds this clip with all its files unchanged.
bool is_made(const ClipPlan& plan, const std::filesystem::path& folder);

/// The paths of a clip's files below the folder of the set.
struct ClipFiles {
    std::filesystem::path script, strip, video, events, columns;
    std::filesystem::path lower_script;  ///< empty unless the clip is chimeric
    std::filesystem::path sound;         ///< empty when there is none
    std::filesystem::path aois, aoi_columns, aoi_key_frames,
        aoi_ias;                    ///< empty when none are asked for
    std::filesystem::path sidecar;  ///< written last: a clip that has it is complete
    /// All files but the sidecar, which lists them.
    std::vector<std::filesystem::path> listed() const;
};
ClipFiles clip_files(const ClipPlan& plan);
/// Returns the path of the clip below "stimuli", as tables have it.
std::string file_in_stimuli(const ClipPlan& plan);
/// Returns the suffix that BIDS has for the clip's file: video, audiovideo or image.
const char* clip_type(const ClipPlan& plan);

/// Keeps, for all workers, how far a face moves when an expression is settled at full intensity.
class SettledMotions {
  public:
    /// Returns the known value, or that of `measure`, mm.
    double at(const std::string& key, const std::function<double()>& measure);

  private:
    std::mutex mutex_;
    std::map<std::string, double> known_;
};

/// The resources with which a worker of a batch makes clips.
struct ClipWorker {
    const std::filesystem::path& folder;  ///< folder of the set
    int threads;                          ///< RenderRequest::threads
    int clips_at_once;                ///< number of clips that this process makes at the same time
    animate::RenderInputs& inputs;    ///< shared by all workers
    animate::RenderSession& session;  ///< owned by this worker
    SettledMotions& settled;          ///< shared by all workers
    const ProgressMonitor& monitor;
};

/// Returns the job that renders a clip's script into the file `out`. The script is that of the plan, in memory. `frame`: the only
/// frame to render; default: all frames.
animate::RenderJob render_job_of(const ClipPlan& plan, const std::filesystem::path& out,
                                 const media::VideoOptions& coding, const ClipWorker& worker,
                                 std::optional<int> frame = {});
/// Returns the record of a run without the parts that differ between runs or between folders.
Json portable_record(const animate::RunRecord& record);
std::string text_of_file(const std::filesystem::path& file);

/// Makes a clip. Throws Error, RunError and Interrupted. After an exception no new file has its final name, except files that the
/// next attempt replaces.
void make_clip(const ClipPlan& plan, const ClipWorker& worker);

/// Returns the sidecar of an existing clip.
Json clip_record(const ClipPlan& plan, const std::filesystem::path& folder);

}  // namespace risorius::stimuli
