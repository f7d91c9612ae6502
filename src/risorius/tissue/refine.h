// SPDX-License-Identifier: MIT
/// \file
/// Adaptive resolution: cells are split where the strain asks for it and merged again where it no longer does, with the
/// material, which does not depend on the resolution, unchanged.
///
///   eta_c^2   estimated squared error of a cell in the energy norm, J (strain_error.h)      E   energy of the deformation, J
///   a cell's due is tolerance^2 E / number of cells: with every cell at its due, the whole body is at the tolerance
#pragma once

#include <functional>
#include <memory>
#include <set>

#include "risorius/solve/motion_system.h"
#include "risorius/tissue/cell_solid.h"
#include "risorius/tissue/detail/cell_tree.h"

namespace risorius::tissue {

struct RefineOptions {
    /// Estimated error in the energy norm, as a share of that of the deformation: the whole body's target. A cell is split
    /// when its squared error is more than its due.    (0, 1)
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
    const CellTree& tree() const { return tree_; }

    /// At rest on the present mesh.
    solve::MotionState start() const;

    /// Splits every leaf for which `wanted` until none is left or all are at the deepest level: patches that are pushed or
    /// held must be seen. They are not merged again. True when anything changed; a state given is carried over.
    bool refine_where(const std::function<bool(const CellMesh::Cell& cell)>& wanted,
                      solve::MotionState* state = nullptr);

    /// Splits and merges as the strain of `state` asks, and carries positions and velocities over by trilinear
    /// interpolation. Systems and terms made from the former solid must be made anew when it returns true.
    bool refine(solve::MotionState& state);

    /// Of the last refine(), before it changed anything: the root of sum eta_c^2 / E.
    double estimated_error() const { return error_; }

  private:
    void rebuild(solve::MotionState* state);

    BodyOnMesh body_;
    RefineOptions options_;
    CellTree tree_;
    std::set<CellPlace> kept_;  ///< splits that were asked for
    std::shared_ptr<CellSolid> solid_;
    double error_ = 0;
};

/// How well an equilibrium is needed: to see where the strain is, or to be the answer.
enum class SolveStage { kIntermediate, kFinal };

/// Moves `state` to equilibrium under what acts on the solid; false where that fails. Systems, which differ from mesh to
/// mesh, and the solver are of the caller's choice.
using SolveSolid = std::function<bool(const std::shared_ptr<CellSolid>& solid, SolveStage stage,
                                      solve::MotionState& state)>;

struct RefineRounds {
    int meshes = 0;          ///< on which an equilibrium was found
    bool converged = false;  ///< every one was found, the final one too
    bool satisfied = false;  ///< nothing is left to refine; false when the rounds were over before
};

/// The rounds of settling and refining, of whatever body.
RefineRounds refine_rounds(int rounds, const std::function<bool(SolveStage stage)>& solve,
                           const std::function<bool()>& refine);

/// Settles and refines in turn until nothing is refined any more, or `rounds` are over. The state left is the equilibrium
/// of the last mesh.
RefineRounds solve_and_refine(AdaptiveSolid& solid, const SolveSolid& solve, int rounds,
                              solve::MotionState& state);

}  // namespace risorius::tissue
