// SPDX-License-Identifier: MIT
/// \file
/// What would otherwise be found wrong only while a clip is made: everything that the renderer reads, and filters that need more
/// pixels than the face has.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "risorius/animate/planned_landmarks.h"
#include "risorius/stimuli/detail/clip.h"
#include "risorius/track/script.h"

namespace risorius::stimuli {

/// Checks the clips of a design. What many of them have in common is checked once. Several threads may use it.
class ClipChecks {
  public:
    /// `script`: that of the clip. Throws Error naming `place`, or the file that is wrong.
    void check(const ClipPlan& plan, const track::ScriptDescription& script,
               animate::RenderInputs& inputs, const std::string& place);

    /// Inputs for plans of scripts that speak.
    animate::RenderInputs& quick_inputs() { return quick_; }

  private:
    void check_render(const ClipPlan& plan, animate::RenderInputs& inputs);
    void check_filter(const ClipPlan& plan, const track::ScriptDescription& script,
                      animate::RenderInputs& inputs, const std::string& place);
    const animate::PlannedLandmarks& landmarks_of(const ClipPlan& plan,
                                                  animate::RenderInputs& inputs);

    std::mutex mutex_;
    std::set<std::string> rendered_;
    std::map<std::string, std::unique_ptr<const animate::PlannedLandmarks>> landmarks_;
    /// A plan does not simulate the mouths of a rig that has not spoken yet.
    animate::RenderInputs quick_{ProgressMonitor{}, animate::RenderInputs::Poses::kOnlyKnown};
};

}  // namespace risorius::stimuli
