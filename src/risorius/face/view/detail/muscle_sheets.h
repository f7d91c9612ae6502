// SPDX-License-Identifier: MIT
/// \file
/// Middle surfaces of flat muscles: grids of points, rows along the fibres from origin to insertion, columns across.
///
/// Point of row i and column j: i * columns + j. Frame: the head frame, m.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/muscle/detail/muscle_placement.h"
#include "risorius/geom/closest_point.h"
#include "risorius/rig/head.h"
#include "risorius/rig/muscle_table.h"

namespace risorius::face {

/// Motion of the bones that muscles are attached to; the skull is fixed.
struct BoneMotion {
    Rigid mandible = Rigid::Identity();
    Vec3 hyoid_m = Vec3::Zero();  ///< displacement
};

struct SheetSize {
    int rows = 0, columns = 0;
    double length_m = 0, width_m = 0;  ///< at rest, the width that of the belly

    double along(int row) const { return static_cast<double>(row) / (rows - 1); }  ///< 0..1
    /// -1..1, closer together towards the rounded edges.
    double across(int column) const;
    int points() const { return rows * columns; }
};

/// A bundle of fibres in the tissue: a smooth surface through its strands.
class FibreSheet {
  public:
    FibreSheet(const MusclePlacement& placement, const FibreBundle& bundle);

    const SheetSize& size() const { return size_; }
    /// `fibre_points`: current positions of the points of all fibres, m.
    void place(const Points& fibre_points, Points& grid) const;

  private:
    struct Mix {  ///< of four neighbours, weights of a Catmull-Rom curve
        int of[4];
        double weight[4];
    };
    SheetSize size_;
    int strands_;
    std::vector<Mix> stations_;  ///< rows x strands, of fibre points
    std::vector<Mix> columns_;   ///< rows x columns, of strands
};

/// The part of the skin that faces outwards at rest: without nostrils, ear canals and other surfaces that are turned inwards.
geom::SurfaceTree outer_skin(const rig::Head& head);

/// A muscle between bones: its ends move with the bones, and the motion is interpolated between them.
class BoneSheet {
  public:
    /// `skin`: outer skin at rest. Wide muscles near it are curved like it.
    BoneSheet(const rig::Head& head, const rig::Muscle& muscle, const rig::MusclePath& path,
              const geom::SurfaceTree& skin);

    const SheetSize& size() const { return size_; }
    void place(const BoneMotion& bones, Points& grid) const;

  private:
    SheetSize size_;
    std::vector<Vec3> centre_;      ///< rows
    std::vector<Vec3> offset_;      ///< rows x columns
    std::vector<double> fraction_;  ///< rows, fraction of the mandible's motion
    std::vector<double> hyoid_fraction_;
};

}  // namespace risorius::face
