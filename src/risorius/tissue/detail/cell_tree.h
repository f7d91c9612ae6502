// SPDX-License-Identifier: MIT
/// \file
/// Which cells of a root grid are split: an octree in every root cell. It is balanced, so that neighbours across faces, edges
/// and corners differ by one level at most.
///
/// The 2:1 balance follows Bangerth, Hartmann & Kanschat 2007, ACM TOMS 33(4).
#pragma once

#include <set>

#include "risorius/tissue/detail/cell_mesh.h"

namespace risorius::tissue {

/// The split cells over one root grid.
class CellTree {
  public:
    explicit CellTree(const GridShape& root) : root_(root) {}

    const GridShape& root() const { return root_; }
    bool is_split(const CellPlace& cell) const { return split_.contains(cell); }
    bool exists(const CellPlace& cell) const;  ///< as a leaf or split

    /// Splits a cell into eight. Larger neighbours are split first, and so are the cells that contain this one, if it does not
    /// exist yet. Throws std::invalid_argument for a place outside the root grid.
    void split(const CellPlace& cell);
    /// Merges the eight children of a cell. Returns false and changes nothing when the cell is not split, when its children are
    /// not all leaves, or when a neighbour is too fine.
    bool merge(const CellPlace& cell);

    CellMesh mesh() const;

  private:
    bool inside(const CellPlace& cell) const;

    GridShape root_;
    std::set<CellPlace> split_;
};

CellPlace parent_of(CellPlace cell);                    ///< of a cell below the root level
CellPlace child_of(const CellPlace& cell, int corner);  ///< the child at that corner

}  // namespace risorius::tissue
