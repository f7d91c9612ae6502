// SPDX-License-Identifier: MIT
/// \file
/// Simulates another script on the same rig at the same times, so that vertex positions can be compared.
#pragma once

#include <memory>

#include "risorius/core/types.h"
#include "risorius/face/quality.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/script.h"

namespace risorius::animate {

class ReferenceRun {
  public:
    /// Builds a face of its own. `files` must outlive this object.
    ReferenceRun(const track::ScriptDescription& script, const scene::RigFiles& files,
                 const face::Quality& quality);
    ~ReferenceRun();

    /// Positions of the vertices at a time, V x 3, m. Times must ascend from call to call.
    Points at(double t_s);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::animate
