// SPDX-License-Identifier: MIT
/// \file
/// Adaptive resolution of solids. Cells are split where their estimated error is too large, and merged where it has become
/// small. The material does not depend on the resolution and does not change.
///
///   eta_c^2   estimated squared error of a cell in the energy norm, J (strain_error.h)      E   energy of the deformation, J
///   budget of a cell: tolerance^2 E / number of cells. When every cell meets its budget, the whole body meets the tolerance
#pragma once

#include <functional>
#include <memory>
#include <set>

#include "risorius/solve/motion_system.h"
#include "risorius/tissue/cell_solid.h"
#include "risorius/tissue/detail/cell_tree.h"

namespace risorius::tissue {

/// When cells are split and merged.
struct RefineOptions {
    /// Allowed error of the whole body: estimated error in the energy norm, divided by the energy norm of the deformation. A
    /// cell is split when its squared error exceeds its budget. (0, 1)
    double tolerance = 0.1;
    /// Eight cells are merged when their summed squared error is below this fraction of one cell's budget; 0: never   [0, 1)
    double merge_below = 0.02;
    int deepest_level = 2;  ///< maximum number of splits of a root cell    [0, 8]
};

/// Returns the body on a mesh. The mesh has the root grid of the body.
using BodyOnMesh = std::function<CellBody(CellMesh mesh)>;

/// A solid whose mesh adapts to its strain. It makes a new CellSolid for each mesh.
class AdaptiveSolid {
  public:
    /// Begins with the root grid. Throws std::invalid_argument for options outside their ranges.
    AdaptiveSolid(const GridShape& root, BodyOnMesh body, const RefineOptions& options);
    /// Begins with the grid of the description. Each cell distributes its mass to its corners.
    AdaptiveSolid(const GridSolid& solid, const RefineOptions& options);

    const std::shared_ptr<CellSolid>& solid() const { return solid_; }
    const CellTree& tree() const { return tree_; }

    /// The rest state on the present mesh.
    solve::MotionState start() const;

    /// Splits every leaf for which `wanted` is true, and the new leaves too, until `wanted` is false for every leaf above the
    /// deepest level. Use it for regions that are pushed or held, where the mesh must be fine. These splits are never merged.
    /// Positions and velocities of `state` are interpolated on the new mesh. Returns true when the mesh has changed.
    bool refine_where(const std::function<bool(const CellMesh::Cell& cell)>& wanted,
                      solve::MotionState* state = nullptr);

    /// Splits and merges cells once, according to the strain of `state`. Positions and velocities are interpolated on the new
    /// mesh. Returns true when the mesh has changed; then the caller must build its systems and terms again with the new
    /// solid().
    bool refine(solve::MotionState& state);

    /// Estimated relative error at the last refine(), before it changed the mesh: sqrt(sum eta_c^2 / E).
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

/// The purpose of a solve: to estimate the error for the next mesh, or to get the result.
enum class SolveStage { kIntermediate, kFinal };

/// Moves `state` to equilibrium under the loads on the solid. Returns false when no equilibrium was found. The caller chooses
/// the system, which differs from mesh to mesh, and the solver.
using SolveSolid = std::function<bool(const std::shared_ptr<CellSolid>& solid, SolveStage stage,
                                      solve::MotionState& state)>;

/// The outcome of solving and refining.
struct RefineRounds {
    int meshes = 0;          ///< meshes on which an equilibrium was found
    bool converged = false;  ///< an equilibrium was found on every mesh, the last one included
    bool satisfied = false;  ///< the last refine() changed nothing
};

/// Solves and refines in turn, for any kind of body. `solve` returns false when it found no equilibrium, and `refine` returns
/// false when it changed nothing. Ends when `refine` has changed nothing or after `rounds` solves, with a final solve on the
/// last mesh; or when a solve fails.
RefineRounds refine_rounds(int rounds, const std::function<bool(SolveStage stage)>& solve,
                           const std::function<bool()>& refine);

/// Solves for equilibrium and refines a solid in turn, as refine_rounds() does. On return, `state` is the equilibrium on the
/// last mesh.
RefineRounds solve_and_refine(AdaptiveSolid& solid, const SolveSolid& solve, int rounds,
                              solve::MotionState& state);

}  // namespace risorius::tissue
