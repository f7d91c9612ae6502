// SPDX-License-Identifier: MIT
/// \file
/// Measures of one side of a volume muscle.
#pragma once

#include <array>
#include <string>

#include "risorius/core/types.h"

namespace risorius::face {

/// Each ratio is the current value / the value at rest.
struct SolidFigures {
    std::string muscle;
    Side side = Side::kLeft;
    double volume_ratio = 1;     ///< of the whole muscle
    double min_cell_ratio = 1;   ///< minimum over its cells of the volume
    double mean_stretch = 1;     ///< mean over its fibres of the length
    double thickness_ratio = 1;  ///< of the middle section
};

/// The tissue around one side of a volume muscle, at rest.
struct BesideSolid {
    std::string muscle;
    Side side = Side::kLeft;
    int nodes = 0;          ///< nodes of the muscle inside of the tissue, not on bone
    double tissue_pa = 0;   ///< mean shear modulus of the tissue at them
    double softest_pa = 0;  ///< minimum of it
    double muscle_pa = 0;   ///< shear modulus of the relaxed muscle across its fibres
    double ratio() const { return nodes > 0 ? tissue_pa / muscle_pa : 0; }
};

/// State of a cell of a volume muscle, in the head frame.
struct SolidCellState {
    std::array<int, 8> node{};  ///< of the volume muscles: the lower face round, then the upper one
    int column = 0;             ///< of the activation vector
    double volume_ratio = 1;    ///< volume / rest volume
    Mat3 stress_pa = Mat3::Zero();   ///< Cauchy stress at its centre, without fibres and damping
    Vec3 direction = Vec3::UnitX();  ///< along the fibres, unit
    double stretch = 1,
           tension_n = 0;  ///< mean of the four chains at its edges, see muscle::ChainSet::State
};

}  // namespace risorius::face
