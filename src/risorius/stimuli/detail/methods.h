// SPDX-License-Identifier: MIT
/// \file
/// A paragraph of methods for the paper, written from what was made, and tags of HED for each clip.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// Returns methods.md. What only the laboratory knows stands in square brackets.
std::string methods_text(const BatchPlan& plan, const std::vector<Json>& records);

/// Returns what a clip shows in tags of Hierarchical Event Descriptors 8.3.0 (hedtags.org).
std::string hed_tags(const ClipPlan& plan);

}  // namespace risorius::stimuli
