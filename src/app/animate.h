// From a script to a video: the function to read first.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/run_record.h"
#include "app/watch.h"

namespace risorius::app {

struct PictureSize {
    int width_px = 0, height_px = 0;
};

/// What is not given is as the script says.
struct AnimateOptions {
    std::filesystem::path script;
    std::filesystem::path out;  ///< .mp4, .mkv, a folder "frames/", or .png for a still
    std::optional<std::filesystem::path> rig;
    std::optional<PictureSize> size;
    std::optional<int> fps;
    std::optional<std::string> camera;
    std::optional<std::string> show;  ///< render::show_names()
    std::optional<double> still_s;    ///< one picture, of this time, instead of a video
    std::string quality = "video";    ///< sim::quality_named
    bool landmarks = false;           ///< their places in the table
    bool emg = false;                 ///< what electrodes would record, in the table
    int threads = 2;                  ///< 1, or more to simulate beside drawing; same frames
};

/// Writes OUT, and beside it OUT.json (the record returned) and OUT.frames.tsv; all of them or none. Throws Error for
/// input, RunError when writing fails, Interrupted when asked to stop.
RunRecord animate(const AnimateOptions& options, const Watch& watch = {});

}  // namespace risorius::app
