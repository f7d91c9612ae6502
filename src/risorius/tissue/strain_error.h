// SPDX-License-Identifier: MIT
/// \file
/// The difference between the strain of a solid of cells and a smoothed strain: an estimate of the discretisation error, cell
/// by cell.
///
///   E_h   strain dG of the cells and their mean dilatation, discontinuous
///   E*    continuous: means over the cells around a vertex, interpolated
///   eta_c^2 = energy of the strain E_h - E* in cell c, J      the sum over cells is about the squared error in the energy norm
///
/// E_h - E* contains the variation of strain within a cell and its jumps to the neighbours. Both shrink with the size of cells.
/// Where the material jumps, the strain of the true solution jumps too, and the estimate is too high.
///
/// Source: Zienkiewicz & Zhu 1987, Int. J. Numer. Meth. Eng. 24(2).
#pragma once

#include <vector>

#include "risorius/tissue/cell_solid.h"

namespace risorius::tissue {

/// eta_c^2 of every cell, J.
Eigen::VectorXd squared_error(const CellSolid& solid, const Points& x);

/// E*: metric strain dG at every vertex, hanging ones included, m^2.
std::vector<Mat3> smooth_strain(const CellSolid& solid, const Points& x);

}  // namespace risorius::tissue
