// SPDX-License-Identifier: MIT
/// \file
/// What the skin does in addition to the tissue: it evens out the motion of the coarse tissue (skin_surface.h), folds where it is
/// compressed (wrinkles.h), and forms cords on the neck (platysma_cords.h). At rest it does nothing.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/skin/detail/platysma_cords.h"
#include "risorius/face/skin/detail/skin_binding.h"
#include "risorius/face/skin/detail/skin_surface.h"
#include "risorius/face/skin/detail/wrinkle_lines.h"
#include "risorius/face/skin/detail/wrinkles.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

class SkinLayer {
  public:
    SkinLayer(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
              const std::array<EyeLids, 2>& lids, const Shell& shell, const TissueMesh& mesh,
              const SkinBinding& binding);

    /// `vertices` (V x 3, m) as the tissue carries them, with the activation of every muscle. Returns the depth of folds that are finer than
    /// the mesh, V x 3, m, one column per slot of lines(); < 0 where lines stand out. No rows when wrinkles are off.
    Points apply(const Eigen::VectorXd& activation, Points& vertices) const;

    /// The depth of such folds on a skin that something else has moved, including what its mesh resolves.
    Points fold_depth(const Eigen::VectorXd& activation, Points vertices) const;

    const WrinkleLines& lines() const { return lines_; }
    const Wrinkles& wrinkles() const { return wrinkles_; }
    const SkinSurface& surface() const { return surface_; }

  private:
    bool folds_;
    WrinkleLines lines_;
    Wrinkles wrinkles_;
    SkinSurface surface_;
    PlatysmaCords cords_;
    std::vector<std::pair<int, int>> alike_;  // a vertex, and the vertex whose shift it shares
    mutable Points shift_;                    // of alike_, scratch
};

}  // namespace risorius::face
