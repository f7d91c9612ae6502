// SPDX-License-Identifier: MIT
/// \file
/// Matches luminance and contrast over a set: all conditions are rendered and measured first, then clips are shown through one map of
/// linear light, or each through its own. The report is
///
///   luminance/luminance.tsv     for each clip: mean and standard deviation before and after, the map, and what it clips
///   luminance/luminance.json    for all conditions together, and the target
///   luminance/mean.svg, sd.svg  the clips in their order, before and after (and as .png, with what they are drawn from)
///
/// Means and deviations are over all pixels of all frames that count: the picture, or the oval of the face.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// The conditions that are not measured yet, by their indices in the plan.
std::vector<std::size_t> unmeasured(const BatchPlan& plan, const std::filesystem::path& folder);

/// Sets the map of each clip; all conditions must be measured. Throws Error when the target cannot be reached.
void match_luminance(const std::filesystem::path& folder, BatchPlan& plan);

/// The report of clips that are all made; the names of its files in `folder`.
std::vector<std::filesystem::path> write_luminance_report(const BatchPlan& plan,
                                                          const std::vector<Json>& records,
                                                          const std::filesystem::path& folder);

/// In a sentence or two.
std::string luminance_text(const std::vector<Json>& records);

}  // namespace risorius::stimuli
