// SPDX-License-Identifier: MIT
/// \file
/// Which cells of a root grid are split: an octree over every root cell, balanced so that neighbours, across edges and
/// corners too, differ by one level at most.
///
/// 2:1 balance as in Bangerth, Hartmann & Kanschat 2007, ACM TOMS 33(4).
#pragma once

#include <set>

#include "risorius/tissue/detail/cell_mesh.h"

namespace risorius::tissue {

class CellTree {
  public:
    explicit CellTree(const GridShape& root) : root_(root) {}

    const GridShape& root() const { return root_; }
    bool is_split(const CellPlace& cell) const { return split_.contains(cell); }
    bool exists(const CellPlace& cell) const;  ///< as a leaf or split

    /// Splits a cell into eight, and bigger neighbours first. A cell that does not exist yet is made. Throws
    /// std::invalid_argument for a place outside the root grid.
    void split(const CellPlace& cell);
    /// Makes a leaf of a cell whose eight parts are leaves; false, and nothing done, where it is none or a neighbour is
    /// too fine for that.
    bool merge(const CellPlace& cell);

    CellMesh mesh() const;

  private:
    bool inside(const CellPlace& cell) const;

    GridShape root_;
    std::set<CellPlace> split_;
};

CellPlace parent_of(CellPlace cell);                    ///< of a cell below the root grid
CellPlace child_of(const CellPlace& cell, int corner);  ///< the part at that corner

}  // namespace risorius::tissue
