// From a script to a video: plans it, hands it to film() and keeps what comes out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/animate/detail/run_record.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/media/video_writer.h"

namespace risorius::animate {

struct PictureSize {
    int width_px = 0, height_px = 0;
};

/// Patches for machines that watch the screen, by names of media::corner_names(). See media/sync_marks.h.
struct SyncMarks {
    std::optional<std::string> photodiode, frame_counter;
    int photodiode_px = 64, frame_counter_px = 8;  ///< side of the square, and of a cell
    std::string photodiode_shows =
        "frames";  ///< "frames": white in even ones; "events": where one begins
};

/// What is not given is as the script says.
struct AnimateOptions {
    std::filesystem::path script;
    std::filesystem::path
        out;  ///< .mp4, .mov, .mkv, .webm, a folder "frames/", or .png for a still
    std::optional<std::filesystem::path> rig;
    std::optional<std::filesystem::path>
        shapes;  ///< .glb of `risorius shapes`: they play the script, nothing is simulated
    std::optional<PictureSize> size;
    std::optional<int> fps;
    std::optional<std::string> camera;
    std::optional<std::string> show;  ///< render::show_names()
    std::optional<double> still_s;    ///< one picture, of this time, instead of a video
    media::VideoOptions
        video{};  ///< how it is coded; size, rate, transparency and sound are set by what is shown
    std::optional<std::filesystem::path> audio;  ///< WAV or FLAC
    std::optional<std::int64_t>
        audio_offset;  ///< samples from the first frame to its first, of its own rate
    SyncMarks marks{};
    std::optional<double> shutter_deg;  ///< 0..360: motion blur; see Shot
    std::vector<std::string> passes;    ///< pass_names(): ground truth as pictures, into OUT.passes
    std::optional<double> turntable_s;  ///< the face of this time, turned once round
    std::optional<std::filesystem::path> against;  ///< show "error": the script to compare with
    std::optional<double> scale;         ///< where the colours of strain (ratio) or error (mm) end
    std::vector<double> times_s;         ///< ascending: these moments instead of every frame
    std::optional<std::string> quality;  ///< face::quality_named; "video", or "draft" for a draft
    std::optional<int> antialiasing;     ///< samples per pixel and side, 1..4; 1 for a draft
    /// Everything goes down as far as it went up, and up where it went down: no face can do that. The head must keep still.
    bool flipped_motion = false;
    bool draft = false;      ///< quickly, to look at: of what is not given, the quickest
    bool landmarks = false;  ///< their places in the table
    bool emg = false;        ///< what electrodes would record, in the table
    int threads =
        2;  ///< 1, or more to simulate beside drawing, several frames at once; same frames
    int films_at_once = 1;  ///< in this process, this one among them; same frames
};

/// Of the simulation, whether given or not.
std::string quality_of(const AnimateOptions& options);

/// Writes OUT, and beside it OUT.json (the record returned) and OUT.frames.tsv; all of them or none. Throws Error for
/// input, RunError when writing fails, Interrupted when asked to stop.
RunRecord animate(const AnimateOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::animate
