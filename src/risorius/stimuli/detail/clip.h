// One clip of a stimulus set: filmed, shown as its control wants it, and written with its ground truth.
//
//   stimuli/stim-NAME_video.mp4                  the pictures; with a recording it is stim-NAME_audiovideo.mp4
//   stimuli/stim-NAME_audio.wav                  the recording by itself, as loud and as long as in the clip
//   stimuli/stim-NAME_annot-frames_events.tsv    a row per frame as it is shown: onset and duration in s, source_frame, and what
//                                                frame_table.h lists
//   stimuli/stim-NAME_video.json                 how it was made; there when, and only when, the clip is complete
//   overview/NAME.png                            five of its frames side by side
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "risorius/animate/animate.h"
#include "risorius/animate/studio.h"
#include "risorius/core/json_cursor.h"
#include "risorius/design/conditions.h"
#include "risorius/design/design.h"
#include "risorius/media/tone.h"
#include "risorius/stimuli/detail/clip_sound.h"

namespace risorius::stimuli {

/// What is to be made, planned and checked.
struct ClipPlan {
    design::Condition condition;
    design::ClipOptions clips;
    std::optional<design::LuminanceMatch> luminance;  ///< the clip is made of a take (take.h)
    std::optional<media::Tone> tone;                  ///< known when all films are measured
    std::optional<ClipSound> sound;
    int frames = 0, fps = 0, width_px = 0, height_px = 0;
    std::array<std::uint8_t, 3> background{};  ///< as it is shown
    std::string scene_sha256;  ///< of face and view, which films after each other may share
    std::string
        film_sha256;  ///< of all that the pictures hang on before they are matched and shown
    std::string
        content_sha256;  ///< of all that the clip hangs on; the same content, the same bytes
    bool take_is_shared = false;  ///< by controls of the clip
    std::size_t film = 0;         ///< a condition's number among the conditions
    double seconds() const;       ///< to make it, about, on two cores
    double megabytes() const;     ///< about
    bool is_control() const { return condition.control.kind != design::ControlKind::kNone; }
    void match(const media::Tone& matched);  ///< once, before the clip is made
};

/// Files of a rig are read once for many clips of it.
class RigDigests {
  public:
    struct Known {
        scene::RigFiles files;
        std::string sha256;  ///< of rig, mesh and tables
    };
    const Known& at(const std::filesystem::path& rig);

  private:
    std::map<std::filesystem::path, Known> known_;
};

/// Checks the script against its rig. Throws Error naming the condition.
ClipPlan plan_clip(const design::Condition& condition, const design::Design& design,
                   RigDigests& rigs, SoundPlans& sounds);

/// Whether `folder` holds this very clip, whole.
bool is_made(const ClipPlan& plan, const std::filesystem::path& folder);

/// The names of a clip's files below its folder.
struct ClipFiles {
    std::filesystem::path script, strip, video, events;
    std::filesystem::path sound;    ///< empty when there is none
    std::filesystem::path sidecar;  ///< written last: a clip that has it is whole
    /// All but the sidecar, which tells of them.
    std::vector<std::filesystem::path> told() const;
};
ClipFiles clip_files(const ClipPlan& plan);

/// The script as it is played, into code/scripts.
void write_clip_script(const ClipPlan& plan, const std::filesystem::path& folder);
/// What a clip is given of the cores.
struct CoreShare {
    int threads = 2;        ///< AnimateOptions::threads
    int clips_at_once = 1;  ///< in this process
};
animate::AnimateOptions film_options(const ClipPlan& plan, const std::filesystem::path& folder,
                                     const std::filesystem::path& out, const CoreShare& share);
/// How it was made, without what differs from one making to the next and from one folder to another.
Json run_without_places(const animate::RunRecord& record);
std::string text_of_file(const std::filesystem::path& file);

/// Throws Error, RunError, Interrupted; then nothing new has a final name but files that the next try replaces.
void make_clip(const ClipPlan& plan, const std::filesystem::path& folder, const CoreShare& share,
               const ProgressMonitor& monitor, animate::Studio& studio);

/// The sidecar of a clip that is made.
Json clip_record(const ClipPlan& plan, const std::filesystem::path& folder);

}  // namespace risorius::stimuli
