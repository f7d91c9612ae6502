// Adaptive resolution: cells are split where the strain asks for it and merged again where it no longer does, with the
// material, which does not depend on the resolution, unchanged.
//
//   E_h   strain 1/2 dG of the cells, discontinuous        E*   continuous: means over the cells round a vertex, interpolated
//   eta_c^2 = sum over Gauss points of the cell  lambda_ij (dG_ij - dG*_ij)^2     an estimate of twice its error in energy
//
// The variation of strain within a cell and its jumps to the neighbours both show in E_h - E*, and both shrink with size.
// Zienkiewicz & Zhu 1987, Int. J. Numer. Meth. Eng. 24(2) (recovery); 2:1 balanced octrees as in Bangerth & al. 2007.
#pragma once

#include <functional>
#include <memory>
#include <set>

#include "solve/motion_system.h"
#include "tissue/cell_solid.h"

namespace risorius::tissue {

/// eta_c^2 of every cell, J.
Eigen::VectorXd error_indicator(const CellSolid& solid, const Points& x);

/// The cells of a root grid and what they were split into; neighbours, across corners too, differ by one level at most.
class CellTree {
  public:
    explicit CellTree(const GridShape& root) : root_(root) {}

    const GridShape& root() const { return root_; }
    bool is_split(const CellPlace& cell) const { return split_.contains(cell); }
    bool exists(const CellPlace& cell) const;  ///< as a leaf or split

    /// Splits a leaf into eight, and bigger neighbours first. Cells that do not exist yet are made.
    void split(const CellPlace& cell);
    /// Makes a leaf of a cell whose eight parts are leaves, unless a neighbour is too fine for that.
    bool merge(const CellPlace& cell);

    CellMesh mesh() const;

  private:
    bool inside(const CellPlace& cell) const;

    GridShape root_;
    std::set<CellPlace> split_;
};

struct RefineOptions {
    /// Estimated error in the energy norm, as a share of that of the deformation: the whole body's target. A cell is split
    /// when its share of it is more than its due, an equal part for every cell.    (0, 1)
    double tolerance = 0.1;
    /// Eight cells are merged when all of them together have less than this share of one cell's due; 0 = never   [0, 1)
    double merge_below = 0.02;
    int deepest_level = 2;  ///< splits of a root cell at most    [0, 8]
};

/// The body on any mesh of its root grid.
using BodyOnMesh = std::function<CellBody(CellMesh mesh)>;

class AdaptiveSolid {
  public:
    /// Begins with the root grid. Throws std::invalid_argument for options outside their ranges.
    AdaptiveSolid(const GridShape& root, BodyOnMesh body, const RefineOptions& options);
    /// On the description's grid, a cell's mass on its corners.
    AdaptiveSolid(const GridSolid& solid, const RefineOptions& options);

    const std::shared_ptr<CellSolid>& solid() const { return solid_; }

    /// Splits every leaf for which `wanted` until none is left or all are at the deepest level: patches that are pushed or
    /// held must be seen. They are not merged again.
    void refine_where(const std::function<bool(const CellMesh::Cell& cell)>& wanted,
                      solve::MotionState* state = nullptr);

    /// Splits and merges as the strain of `state` asks, and carries positions and velocities over by trilinear
    /// interpolation. Systems and terms made from the former solid must be made anew when it returns true.
    bool refine(solve::MotionState& state);

    double estimated_error() const {
        return error_;
    }  ///< of the last refine(), before it changed anything

  private:
    void rebuild(solve::MotionState* state);

    BodyOnMesh body_;
    RefineOptions options_;
    CellTree tree_;
    std::set<CellPlace> kept_;  ///< splits that were asked for
    std::shared_ptr<CellSolid> solid_;
    double error_ = 0;
};

/// What else acts on the solid, made anew for every mesh: masses, fixed nodes, the solid itself and other terms.
using SystemOfSolid =
    std::function<std::unique_ptr<solve::MotionSystem>(const std::shared_ptr<CellSolid>& solid)>;

/// Moves `state` to equilibrium; returns false where that fails. The solver of the caller's choice.
using Settle = std::function<bool(const solve::MotionSystem& system, solve::MotionState& state)>;

/// Settles and refines in turn until nothing is refined any more, or `rounds` are over. Returns the rounds done; 0 when
/// the first could not be settled.
int settle_and_refine(AdaptiveSolid& solid, const SystemOfSolid& system, const Settle& settle,
                      int rounds, solve::MotionState& state);

}  // namespace risorius::tissue
