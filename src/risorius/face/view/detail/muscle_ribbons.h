// SPDX-License-Identifier: MIT
/// \file
/// Surfaces for drawing the muscles that have no volume in the simulation (bundles of fibres, and muscles attached to bones only). They are
/// ribbons: a middle surface with thickness on both sides. Where a ribbon shortens, it becomes thicker, so that its volume is constant.
#pragma once

#include <variant>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/muscle/detail/muscle_placement.h"
#include "risorius/face/muscle/detail/muscle_surface.h"
#include "risorius/face/view/detail/muscle_sheets.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// The ribbons of one face.
class MuscleRibbons {
  public:
    /// Adds to `surfaces` one surface for every bundle of fibres, and one for every other muscle that is not a solid.
    MuscleRibbons(const rig::Head& head, const rig::RigDescription& rig,
                  const MusclePlacement& placement, MuscleSurfaces& surfaces);

    /// Writes the rows of the ribbons in `vertices`, m, head frame. `nodes`: current positions of the nodes of the tissue, n x 3, m.
    void place(const Points& nodes, const BoneMotion& bones, Points& vertices) const;

  private:
    /// One ribbon.
    struct Strap {
        std::variant<FibreSheet, BoneSheet> sheet;
        SheetSize size;
        Eigen::Index first_vertex = 0;
        double outward = 1;                   ///< 1 or -1: orientation of rows relative to columns
        std::vector<double> over_m, under_m;  ///< thickness on the side of the skin and of the bone
        std::vector<double> rest_area_m2;
    };
    void add(std::variant<FibreSheet, BoneSheet> sheet, const rig::Head& head,
             const rig::Muscle& muscle, const Vec2& bone_ends, const geom::SurfaceTree& skin,
             MuscleSurface& surface, MuscleSurfaces& surfaces);
    Points place_fibre_points(const Points& nodes, const BoneMotion& bones) const;
    void place_strap(const Strap& strap, const Points& fibre_points, const BoneMotion& bones,
                     Points& vertices) const;
    void place_grid(const Strap& strap, const Points& fibre_points, const BoneMotion& bones,
                    Points& grid) const;

    std::vector<muscle::FibrePoint> points_;
    Points rest_points_;
    std::vector<Strap> straps_;
};

}  // namespace risorius::face
