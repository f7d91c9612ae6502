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
#include "risorius/plot/write_chart.h"
#include "risorius/stimuli/batch.h"
#include "risorius/stimuli/detail/write_below.h"

namespace risorius::stimuli {

/// Returns the indices, in the plan, of the conditions that are not yet measured.
std::vector<std::size_t> unmeasured(const BatchPlan& plan, const std::filesystem::path& folder);

/// Sets the map of luminance of each clip. All conditions must be measured. Throws Error when the target cannot be reached.
void match_luminance(const std::filesystem::path& folder, BatchPlan& plan);

inline constexpr const char* kLuminanceFolder = "luminance";

/// Writes the report, and returns the charts that belong to it in the same folder. All clips must exist.
std::vector<plot::Chart> write_luminance_report(const BatchPlan& plan,
                                                const std::vector<Json>& records,
                                                const WriteFile& write);

/// Returns a summary of the matching in one or two sentences.
std::string luminance_text(const std::vector<Json>& records);

}  // namespace risorius::stimuli
