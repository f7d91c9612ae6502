// SPDX-License-Identifier: MIT
/// \file
/// Estimates the discretisation error of each cell of a solid: the difference between the strain of the solid and a smoothed
/// strain.
///
///   e_h   strain dG of the cells and their mean dilatation, discontinuous between cells
///   e*    smoothed strain, continuous: means over the cells around each vertex, interpolated
///   eta_c^2 = energy of the strain e_h - e* in cell c, J      the sum over cells is about the squared error in the energy norm
///
/// e_h - e* contains the variation of strain within a cell and its jumps to the neighbours. Both shrink with the size of cells.
/// Between two materials the strain of the true solution is discontinuous too, and the estimate is too high.
///
/// Source: Zienkiewicz & Zhu 1987, Int. J. Numer. Meth. Eng. 24(2).
#pragma once

#include <vector>

#include "risorius/tissue/cell_solid.h"

namespace risorius::tissue {

/// eta_c^2 of every cell, J.
Eigen::VectorXd squared_error(const CellSolid& solid, const Points& x);

/// e*: smoothed metric strain dG at every vertex, hanging ones included, m^2.
std::vector<Mat3> smooth_strain(const CellSolid& solid, const Points& x);

}  // namespace risorius::tissue
