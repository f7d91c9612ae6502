// Two scripts, or two heads under one script, side by side in one video.
#pragma once

#include <filesystem>

#include "risorius/animate/animate.h"

namespace risorius::animate {

/// Left and right: `script` and `rig` may differ. Size, rate, coding and sound are those of the left one; the video lasts as long
/// as the longer of both, the other one stays as it was in its last frame.
///
/// Writes left.out, and beside it OUT.json (both records), OUT.left.frames.tsv and OUT.right.frames.tsv. Throws Error, RunError,
/// Interrupted.
Json compare(const AnimateOptions& left, const AnimateOptions& right,
             const ProgressMonitor& monitor = {});

}  // namespace risorius::animate
