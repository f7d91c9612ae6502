// SPDX-License-Identifier: MIT
/// \file
/// Middle surfaces of flat muscles: grids of points, rows along the fibres from origin to insertion, columns across.
///
/// The point of row i and column j has the index i * columns + j. Positions are in the head frame, m.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/muscle/detail/muscle_placement.h"
#include "risorius/geom/closest_point.h"
#include "risorius/rig/head.h"
#include "risorius/rig/muscle_table.h"

namespace risorius::face {

/// Motion from rest, in the head frame, of the bones that muscles are attached to. The skull does not move.
struct BoneMotion {
    Rigid mandible = Rigid::Identity();
    Vec3 hyoid_m = Vec3::Zero();  ///< displacement, m
};

/// Size of a grid of points.
struct SheetSize {
    int rows = 0, columns = 0;
    double length_m = 0, width_m = 0;  ///< at rest; the width is that of the belly

    double along(int row) const { return static_cast<double>(row) / (rows - 1); }  ///< 0..1
    /// Returns the position of a column across, -1..1. Columns are closer together near the rounded edges.
    double across(int column) const;
    int points() const { return rows * columns; }
};

/// The middle surface of a bundle of fibres in the tissue: a smooth surface through the fibres.
class FibreSheet {
  public:
    FibreSheet(const MusclePlacement& placement, const FibreBundle& bundle);

    const SheetSize& size() const { return size_; }
    /// Writes the grid. `fibre_points`: current positions of the points of all fibres, m.
    void place(const Points& fibre_points, Points& grid) const;

  private:
    /// Four neighbours and their weights in a Catmull-Rom curve.
    struct Mix {
        int of[4];
        double weight[4];
    };
    SheetSize size_;
    int strands_;
    std::vector<Mix> stations_;  ///< rows x fibres, mixes of fibre points
    std::vector<Mix> columns_;   ///< rows x columns, mixes of fibres
};

/// Returns the part of the skin that faces outwards at rest: without nostrils, ear canals and other surfaces that face inwards.
geom::SurfaceTree outer_skin(const rig::Head& head);

/// The middle surface of a muscle between bones. Its ends move with the bones; between them the motion is interpolated.
class BoneSheet {
  public:
    /// `skin`: the outer skin at rest. Wide muscles near the skin are curved like the skin.
    BoneSheet(const rig::Head& head, const rig::Muscle& muscle, const rig::MusclePath& path,
              const geom::SurfaceTree& skin);

    const SheetSize& size() const { return size_; }
    void place(const BoneMotion& bones, Points& grid) const;

  private:
    SheetSize size_;
    std::vector<Vec3> centre_;            ///< rows
    std::vector<Vec3> offset_;            ///< rows x columns
    std::vector<double> fraction_;        ///< rows, fraction of the mandible's motion
    std::vector<double> hyoid_fraction_;  ///< rows, fraction of the hyoid's motion
};

}  // namespace risorius::face
