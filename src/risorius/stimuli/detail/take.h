// The film of a clip's script as it came out of the simulation, kept without loss until all films of a set are measured and
// their pictures can be matched:
//
//   takes/NAME.mkv     the pictures
//   takes/NAME.tsv     frame_table.h
//   takes/NAME.json    what it hangs on, how it was made, how light it is; there when, and only when, the take is whole
//
// A control that shows the same film otherwise shares the take of its condition.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "risorius/animate/film.h"
#include "risorius/animate/frame_rows.h"
#include "risorius/media/tone.h"
#include "risorius/stimuli/detail/clip.h"

namespace risorius::stimuli {

struct Take {
    std::filesystem::path video;
    Json run;  ///< how it was made
    std::string table;
    media::LuminanceSums luminance;  ///< within what the design says
};

/// Whole, and of this very film: the clip's own or that of the condition it is a control of.
std::optional<Take> find_take(const ClipPlan& plan, const std::filesystem::path& folder);

/// Throws as make_clip().
void make_take(const ClipPlan& plan, const std::filesystem::path& folder, const CoreShare& share,
               const ProgressMonitor& monitor, animate::Studio& studio);

/// What is measured of a clip's film: by its take, or by the clip that was made of it.
std::optional<media::LuminanceSums> measured_luminance(const ClipPlan& plan,
                                                       const std::filesystem::path& folder);

/// The clip's own.
void remove_take(const ClipPlan& plan, const std::filesystem::path& folder);

/// Inside the oval of the face in a frame; empty, which is everywhere, when all of the picture counts.
std::vector<std::uint16_t> measured_part(const ClipPlan& plan, const animate::FrameRows& rows,
                                         int frame);

Json json_of(const media::LuminanceSums& sums);
media::LuminanceSums sums_of(const Json& json);

}  // namespace risorius::stimuli
