// SPDX-License-Identifier: MIT
/// \file
/// A condition as it was rendered, before its pictures are matched in luminance with those of the set. It is kept, losslessly, until
/// all conditions are measured and the clips that show it are made:
///
///   intermediate/NAME.mkv     the pictures
///   intermediate/NAME.tsv     the table of frames, frame_table.h
///   intermediate/NAME.json    what it depends on, how it was made and its luminance; it exists only when the others are complete
///
/// A control that shows the same pictures uses the render of its condition. Earlier versions wrote these files into the folder
/// "takes": they are still found there, and removed with the others.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "risorius/animate/frame_rows.h"
#include "risorius/media/tone.h"
#include "risorius/stimuli/detail/clip.h"

namespace risorius::stimuli {

/// Folders of unmatched renders below that of the set: today's, and the one of earlier versions.
inline constexpr const char* kIntermediateFolders[] = {"intermediate", "takes"};

struct UnmatchedRender {
    std::filesystem::path video;
    Json run;                        ///< how it was made; see portable_record()
    std::string table;               ///< the text of frame_table.h
    media::LuminanceSums luminance;  ///< within the part of the picture that the design names
};

/// The render of the clip, or that of the condition it is a control of; none unless it is complete and of the same script.
std::optional<UnmatchedRender> find_unmatched_render(const ClipPlan& plan,
                                                     const std::filesystem::path& folder);

/// Throws as make_clip().
void make_unmatched_render(const ClipPlan& plan, const ClipWorker& worker);

/// The luminance of a clip before matching, from its unmatched render or from the clip that was made of it.
std::optional<media::LuminanceSums> measured_luminance(const ClipPlan& plan,
                                                       const std::filesystem::path& folder);

/// Removes the clip's own render, not that of its condition.
void remove_unmatched_render(const ClipPlan& plan, const std::filesystem::path& folder);

/// The pixels whose luminance counts in a frame, not 0 within the oval of the face; empty when all of the picture counts.
std::vector<std::uint16_t> measured_part(const ClipPlan& plan, const animate::FrameRows& rows,
                                         int frame);

Json json_of(const media::LuminanceSums& sums);
media::LuminanceSums sums_of(const Json& json);

}  // namespace risorius::stimuli
