// What the skin does by itself on top of the tissue: evens out what the coarse tissue carries it to (skin_surface.h),
// folds where it is compressed (wrinkles.h) and stands off in cords on the neck (platysma_cords.h). At rest it does nothing.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/types.h"
#include "rig/head.h"
#include "rig/rig_description.h"
#include "sim/jaw.h"
#include "sim/lids.h"
#include "sim/platysma_cords.h"
#include "sim/shell.h"
#include "sim/skin_binding.h"
#include "sim/skin_surface.h"
#include "sim/tissue_mesh.h"
#include "sim/wrinkle_lines.h"
#include "sim/wrinkles.h"

namespace risorius::sim {

class SkinLayer {
  public:
    SkinLayer(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
              const std::array<EyeLids, 2>& lids, const Shell& shell, const TissueMesh& mesh,
              const SkinBinding& binding);

    /// `vertices` (V x 3) come as the tissue carries them, with the activation of every muscle. Returns the depth of the folds
    /// that the mesh is too coarse for, V x 3, m, a column per slot of lines(), < 0 where lines stand out; no rows when
    /// wrinkles are off.
    Points apply(const Eigen::VectorXd& activation, Points& vertices) const;

    /// The depth of those folds on a skin that something else has moved, with what its mesh resolves in place already.
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
    std::vector<std::pair<int, int>> alike_;  // vertex, the one whose shift it shares
    mutable Points shift_;                    // of alike_, scratch
};

}  // namespace risorius::sim
