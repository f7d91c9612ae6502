// SPDX-License-Identifier: MIT
/// \file
/// Adaptive resolution of surfaces on any triangle mesh. Triangles are bisected where their estimated error is too large. The
/// material and the rest shape do not change; the rest shape keeps its facets.
///
///   dG   metric strain of a triangle, constant      b - b0   its change of curvature (triangle_sheet.h)
///   dG*, b*   smoothed and continuous: means over the triangles around each node, interpolated
///   eta_t^2 = A (1/4 sum lambda_ij (dG_ij - dG*_ij)^2 + 1/2 sum zeta_ij (b_ij - b*_ij)^2), means over the triangle, J
///
/// The means are taken of components in the coordinates a. So the coordinates of neighbouring triangles must have the same
/// directions, as those of a grid or along a fibre have.
///
/// Sources: Rivara 1984, Int. J. Numer. Meth. Eng. 20(4), for bisection at the longest edge: no angle becomes smaller than half
/// the smallest one; Zienkiewicz & Zhu 1987, Int. J. Numer. Meth. Eng. 24(2), for the estimate.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "risorius/solve/motion_system.h"
#include "risorius/tissue/refine.h"
#include "risorius/tissue/triangle_sheet.h"

namespace risorius::tissue {

/// A surface after bisection.
struct Bisected {
    TriangleSurface surface;  ///< the old nodes come first
    /// For each new node: the two nodes it lies between.
    std::vector<std::array<int, 2>> middle_of;
    std::vector<int> parent;  ///< for each triangle: the old triangle that contains it
};

/// Bisects every marked triangle at its longest edge, and further triangles so that no node lies inside an edge. Of edges of
/// equal length, the one with the lower nodes counts as longest.
Bisected bisected(const TriangleSurface& surface, const std::vector<char>& marked);

/// eta_t^2 of every triangle, J. `term` is the term of `surface`.
Eigen::VectorXd squared_error(const TriangleSurface& surface, const TriangleSheetTerm& term,
                              const Points& x);

/// When triangles are bisected.
struct SurfaceRefineOptions {
    /// Allowed error of the whole surface: estimated error in the energy norm, divided by that of the deformation (0, 1)
    double tolerance = 0.1;
    int max_bisections = 4;  ///< bisections of one triangle; two of them halve its edges    [0, 16]
};

/// A surface whose mesh adapts to its strain. It makes a new TriangleSheetTerm for each mesh.
class AdaptiveSurface {
  public:
    /// `surface` has passed check(). Throws std::invalid_argument for options outside their ranges.
    AdaptiveSurface(TriangleSurface surface, const SurfaceRefineOptions& options);

    const TriangleSurface& surface() const { return surface_; }
    const std::shared_ptr<TriangleSheetTerm>& term() const { return term_; }

    /// The rest state on the present mesh.
    solve::MotionState start() const;

    /// Bisects every triangle for which `wanted` is true, once. Positions and velocities of `state` are interpolated on the new
    /// mesh. Returns true when the mesh has changed.
    bool refine_where(const std::function<bool(int triangle)>& wanted,
                      solve::MotionState* state = nullptr);

    /// Bisects triangles according to the strain of `state`; new nodes lie at the midpoints of edges. Returns true when the
    /// mesh has changed; then the caller must build its systems and terms again with the new term(). Triangles are never
    /// merged.
    bool refine(solve::MotionState& state);

    /// Estimated relative error at the last refine(), before it changed the mesh; see AdaptiveSolid::estimated_error.
    double estimated_error() const { return error_; }

  private:
    bool bisect(const std::vector<char>& marked, solve::MotionState* state);

    TriangleSurface surface_;
    SurfaceRefineOptions options_;
    std::vector<int> bisections_;  ///< of each triangle since the first mesh
    std::shared_ptr<TriangleSheetTerm> term_;
    double error_ = 0;
};

/// Moves `state` to equilibrium under the loads on the surface; see SolveSolid.
using SolveSurface = std::function<bool(const AdaptiveSurface& surface, SolveStage stage,
                                        solve::MotionState& state)>;

/// Solves for equilibrium and refines in turn; see refine_rounds(). On return, `state` is the equilibrium on the last mesh.
RefineRounds solve_and_refine(AdaptiveSurface& surface, const SolveSurface& solve, int rounds,
                              solve::MotionState& state);

}  // namespace risorius::tissue
