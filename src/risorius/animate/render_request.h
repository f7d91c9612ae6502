// SPDX-License-Identifier: MIT
/// \file
/// What a caller asks for when it renders a script. Fields that are not given keep the value of the script.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/media/video_writer.h"

namespace risorius::animate {

struct PictureSize {
    int width_px = 0, height_px = 0;
};

/// Synchronization marks for measuring devices in front of the screen. Corners have the names of media::corner_names(). See
/// media/sync_marks.h.
struct SyncMarks {
    /// Corner of each mark; without a value the mark is not drawn
    std::optional<std::string> photodiode, frame_counter;
    int photodiode_px = 64;    ///< side of the photodiode's square
    int frame_counter_px = 8;  ///< side of a cell of the counter
    /// When the square of the photodiode is white. "frames": in even frames; "events": in the first frame of each event.
    std::string photodiode_shows = "frames";
};

/// The request for one video, or for one still. plan_render_job() makes a RenderJob of it. After that, animate() reads only `audio`
/// of it.
struct RenderRequest {
    std::filesystem::path script;
    /// The script itself when it is in memory. `script` then only names it, and is not read.
    std::optional<JsonCursor> script_in_memory;
    /// A file .mp4, .mov, .mkv or .webm, a folder of PNG frames ("frames/"), or .png for a still.
    std::filesystem::path out;
    std::optional<std::filesystem::path> rig;
    /// A file shapes.glb of `risorius shapes`. Its blend shapes play the script; nothing is simulated.
    std::optional<std::filesystem::path> shapes;
    std::optional<PictureSize> size;
    std::optional<int> fps;
    std::optional<std::string> camera;  ///< a name of render::camera_names()
    std::optional<std::string> show;    ///< a name of render::show_names()
    std::optional<std::string> hair;    ///< "own", or "none": no locks on the scalp
    std::optional<double> still_s;      ///< a still of this time instead of a video
    /// How the video is encoded. plan_render_job() sets size, frame rate, transparency and sound.
    media::VideoOptions video{};
    bool sound = true;  ///< false: the video has no sound, whatever the script says
    std::optional<std::filesystem::path> audio;  ///< WAV or FLAC
    /// Time from the first frame to the first sample of the recording, in samples at the recording's own rate.
    std::optional<std::int64_t> audio_offset;
    SyncMarks marks{};
    std::optional<double> shutter_deg;  ///< 0..360: motion blur; see RenderJob::shutter_deg
    /// Names of pass_names(): ground truth pictures in OUT.passes
    std::vector<std::string> passes;
    /// The head, as it is at this time of the script, makes one turn
    std::optional<double> turntable_s;
    std::optional<std::filesystem::path> against;  ///< show "error": the script to compare with
    std::optional<double> scale;  ///< where the colours of strain (ratio) or error (mm) end
    /// Times of the frames, ascending, if these are given; there are no other frames then
    std::vector<double> times_s;
    /// A name of face::quality_named(); default: "video", or "draft" for a draft
    std::optional<std::string> quality;
    /// Samples per pixel and side, 1..4; default for a draft: 1
    std::optional<int> antialiasing;
    /// True: vertical motion is mirrored, so that vertices move down instead of up and the other way round. No real face moves
    /// like this; it is a control stimulus. The head must not move.
    bool flipped_motion = false;
    bool draft = false;  ///< a fast preview: options that are not given take their fastest value
    bool landmarks = false;  ///< adds the positions of landmarks to the table
    bool emg = false;        ///< adds simulated surface electromyograms to the table
    /// Number of threads. 1: simulation and drawing take turns. More: they run at the same time, and several frames are drawn in
    /// parallel. The frames do not depend on it.
    int threads = 2;
    /// Number of renders that run in this process at the same time, this one included; the frames do not depend on it
    int renders_at_once = 1;
};

/// Returns the quality of the simulation: the requested one, or else the default.
std::string quality_of(const RenderRequest& request);

}  // namespace risorius::animate
