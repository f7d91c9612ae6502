// SPDX-License-Identifier: MIT
/// \file
/// Matches luminance and contrast over a set. All conditions are rendered and measured first. Then the pictures of all clips are
/// mapped by one affine function of linear light, or those of each clip by its own. The report is
///
///   luminance/luminance.tsv     for each clip: mean and standard deviation before and after, the map, and the clipped fraction
///   luminance/luminance.json    for all conditions together, and the target
///   luminance/mean.svg, sd.svg  the clips in their order, before and after (also as .png, with the data of the charts)
///
/// Means and standard deviations are over all measured pixels of all frames. Measured is the whole picture, or the oval of the
/// face.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// Returns the indices, in the plan, of the conditions that are not yet measured.
std::vector<std::size_t> unmeasured(const BatchPlan& plan, const std::filesystem::path& folder);

/// Sets the map of luminance of each clip. All conditions must be measured. Throws Error when the target cannot be reached.
void match_luminance(const std::filesystem::path& folder, BatchPlan& plan);

/// Writes the report. All clips must exist. Returns the names of the files in `folder`.
std::vector<std::filesystem::path> write_luminance_report(const BatchPlan& plan,
                                                          const std::vector<Json>& records,
                                                          const std::filesystem::path& folder);

/// Returns a summary of the matching in one or two sentences.
std::string luminance_text(const std::vector<Json>& records);

}  // namespace risorius::stimuli
