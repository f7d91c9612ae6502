// SPDX-License-Identifier: MIT
/// \file
/// Pictures of a rig, as a camera in front of it would take them.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/scene/rig_files.h"

namespace risorius::perform {

/// Pairs of channel and value. A channel that is not named is 0.
using Pose = std::vector<std::pair<std::string, double>>;

class RigPictures {
  public:
    /// Builds a face and a view, which takes a second or two.
    explicit RigPictures(std::shared_ptr<const scene::RigFiles> rig);
    ~RigPictures();
    RigPictures(const RigPictures&) = delete;
    RigPictures& operator=(const RigPictures&) = delete;

    /// The face in equilibrium, from the front. It does not depend on the pictures before.
    Image draw(const Pose& pose);
    const scene::RigFiles& rig() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::perform
