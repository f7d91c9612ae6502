// SPDX-License-Identifier: MIT
/// \file
/// What the columns of a clip's table of frames are, for the JSON file that BIDS wants beside it.
#pragma once

#include <string>

#include "risorius/stimuli/detail/clip.h"

namespace risorius::stimuli {

/// Returns the text of the file. `table`: the table, of which the first line is read.
std::string frame_columns(const std::string& table, const ClipPlan& plan);

}  // namespace risorius::stimuli
