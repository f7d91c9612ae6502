// SPDX-License-Identifier: MIT
/// \file
/// An unmatched render: a condition as it was rendered, before its luminance is matched with that of the set. It is kept
/// losslessly until all conditions are measured and the clips that use it are made:
///
///   intermediate/NAME.mkv     the pictures, with 16 bits and a transparent background
///   intermediate/NAME.tsv     the table of frames, frame_table.h
///   intermediate/NAME.json    its inputs, how it was made and its luminance; it exists only when the others are complete
///
/// A control that shows the same pictures uses the render of its condition. Earlier versions wrote these files to the folder
/// "takes". They are still found there, and are removed with the others.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "risorius/animate/frame_rows.h"
#include "risorius/core/image.h"
#include "risorius/media/tone.h"
#include "risorius/stimuli/detail/clip.h"
#include "risorius/stimuli/detail/seen_motion.h"

namespace risorius::stimuli {

/// Folders of unmatched renders below the folder of the set: the current one, and that of earlier versions.
inline constexpr const char* kIntermediateFolders[] = {"intermediate", "takes"};

struct UnmatchedRender {
    std::filesystem::path video;
    Json run;                            ///< how it was made; see portable_record()
    std::string table;                   ///< the text of frame_table.h
    media::LuminanceSums luminance;      ///< within the measured part of the picture
    std::string colours;                 ///< ColourSums::text()
    std::optional<SeenPicture> picture;  ///< of a set of pictures: the only frame that it has
};

/// The luminance of a condition before matching.
struct MeasuredLuminance {
    media::LuminanceSums sums;
    media::ColourSums colours;
};

/// Returns the render of the clip, or for a control that of its condition. Returns nothing unless the render is complete and
/// belongs to the same script.
std::optional<UnmatchedRender> find_unmatched_render(const ClipPlan& plan,
                                                     const std::filesystem::path& folder);

/// Renders the condition of a clip. Throws as make_clip() does.
void make_unmatched_render(const ClipPlan& plan, const ClipWorker& worker);

/// Returns the luminance of a clip before matching, from its unmatched render or from the finished clip.
std::optional<MeasuredLuminance> measured_luminance(const ClipPlan& plan,
                                                    const std::filesystem::path& folder);

/// Removes the clip's own render, but not that of its condition.
void remove_unmatched_render(const ClipPlan& plan, const std::filesystem::path& folder);

/// Returns the weights of the pixels of a frame within the oval of the face, which has a soft rim, times opacity.
std::vector<float> weights_in_oval(const ClipPlan& plan, const animate::FrameRows& rows, int frame,
                                   const Image& picture);
/// Returns the weights with which a frame is measured: within the oval, or of the whole picture. What shows the background in part
/// has none.
std::vector<float> measured_weights(const ClipPlan& plan, const animate::FrameRows& rows, int frame,
                                    const Image& picture);

Json json_of(const media::LuminanceSums& sums);
media::LuminanceSums sums_of(const Json& json);

}  // namespace risorius::stimuli
