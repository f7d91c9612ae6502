// SPDX-License-Identifier: MIT
/// \file
/// How far the strain of a solid of cells is from a smooth one: an estimate of its discretisation error, cell by cell.
///
///   E_h   strain dG of the cells and their mean dilatation, discontinuous
///   E*    continuous: means over the cells round a vertex, interpolated
///   eta_c^2 = energy of the strain E_h - E* in cell c, J      sum over cells = squared error in the energy norm, about
///
/// The variation of strain within a cell and its jumps to the neighbours both show in E_h - E*, and both shrink with size.
/// Where the material jumps, so does the strain of the true solution, and the estimate is too high there.
/// Zienkiewicz & Zhu 1987, Int. J. Numer. Meth. Eng. 24(2).
#pragma once

#include <vector>

#include "risorius/tissue/cell_solid.h"

namespace risorius::tissue {

/// eta_c^2 of every cell, J.
Eigen::VectorXd squared_error(const CellSolid& solid, const Points& x);

/// E*: metric strain dG at every vertex, hanging ones included, m^2.
std::vector<Mat3> smooth_strain(const CellSolid& solid, const Points& x);

}  // namespace risorius::tissue
