// SPDX-License-Identifier: MIT
/// \file
/// What planning and making a clip have in common. plan_clip() itself is declared in clip.h.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::stimuli {

struct ClipPlan;

/// Returns the positions in a script that name a file.
std::vector<Json::json_pointer> file_keys(const Json& script);

/// Returns the number of frames from one key frame to the next; none for endings in which every frame is one.
std::optional<int> keyframe_interval(const ClipPlan& plan);

}  // namespace risorius::stimuli
