// SPDX-License-Identifier: MIT
/// \file
/// Sets of pictures: which frame of its script a clip shows.
#pragma once

#include "risorius/core/json_cursor.h"
#include "risorius/stimuli/detail/clip.h"
#include "risorius/stimuli/detail/seen_motion.h"

namespace risorius::stimuli {

/// Plays the script of a clip without drawing, and returns the frame at clips.still_s, or else at the apex. Throws as make_clip()
/// does.
SeenPicture picture_frame(const ClipPlan& plan, const ClipWorker& worker);

/// For the record of an unmatched render.
Json json_of(const SeenPicture& picture);
SeenPicture picture_of(const Json& json);

}  // namespace risorius::stimuli
