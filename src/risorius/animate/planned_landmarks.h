// SPDX-License-Identifier: MIT
/// \file
/// Where landmarks will be in the pictures of a job, before anything is simulated: on the head at rest, as it is turned and moved.
#pragma once

#include <memory>
#include <string>

#include "risorius/animate/render_job.h"
#include "risorius/render/framing.h"
#include "risorius/rig/head.h"

namespace risorius::animate {

class PlannedLandmarks {
  public:
    explicit PlannedLandmarks(const RenderJob& job);

    /// Returns the distance of two landmarks in the picture, px, where a drive turns and moves the head. Throws Error naming the rig when
    /// it lacks one of them.
    double distance_px(const std::string& a, const std::string& b, const track::Drive& drive) const;

  private:
    std::shared_ptr<const RigInput> rig_;
    rig::Head head_;
    render::Framing framing_;
};

}  // namespace risorius::animate
