// SPDX-License-Identifier: MIT
/// \file
/// Motion of the skin in addition to that of the tissue: the skin smooths the motion of the coarse tissue (skin_surface.h), folds where it
/// is compressed (wrinkles.h), and forms cords on the neck (platysma_cords.h). At rest it does not move.
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

/// The skin of one head.
class SkinLayer {
  public:
    SkinLayer(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
              const std::array<EyeLids, 2>& lids, const Shell& shell, const TissueMesh& mesh,
              const SkinBinding& binding);

    /// Moves `vertices` (V x 3, m) from where the tissue carries them to where the skin lies. `activation` has one entry per column of the
    /// rig, 0..1. Returns the depth of folds that are finer than the mesh, V x 3, m, one column per slot of lines(); < 0 where lines stand
    /// out. There are no rows when wrinkles are off.
    Points apply(const Eigen::VectorXd& activation, Points& vertices) const;

    /// Returns the depth of folds, in the same form, on a skin that something other than the simulation has moved. It is the whole depth,
    /// also of folds that the mesh could show.
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
