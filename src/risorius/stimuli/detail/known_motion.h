// SPDX-License-Identifier: MIT
/// \file
/// What a script shows of a movement, kept between runs (core/result_cache.h). The key has the script, the hash of the rig with its
/// mesh and tables, and the quality, beside the build of the program. So the search of match/motion is made once for a design,
/// whichever command comes first.
#pragma once

#include <functional>
#include <vector>

#include "risorius/animate/landmark_run.h"
#include "risorius/stimuli/detail/seen_motion.h"

namespace risorius::stimuli {

/// Returns the farthest way of a landmark of the face, mm, when the movement of a job is settled. `begin`: called before the face is
/// simulated, not when the way is known; it may throw.
double settled_way_mm(const animate::RenderJob& job, animate::RenderSession& session,
                      const std::function<void()>& begin = {}, const LandmarkChoice& choice = {});

/// Returns the farthest way of a landmark of the face in each frame of a job, mm.
std::vector<double> course_mm(const animate::RenderJob& job, animate::RenderSession& session,
                              const ProgressMonitor& monitor,
                              const std::function<void()>& begin = {});

}  // namespace risorius::stimuli
