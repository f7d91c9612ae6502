// SPDX-License-Identifier: MIT
/// \file
/// Adaptive resolution of surfaces on any triangle mesh: triangles are bisected where strain and curvature ask for it, with
/// the material and the rest shape, facets included, unchanged.
///
///   dG   metric strain of a triangle, constant      b - b0   its change of curvature (triangle_sheet.h)
///   dG*, b*   continuous: means over the triangles round a node, interpolated
///   eta_t^2 = A (1/4 sum lambda_ij (dG_ij - dG*_ij)^2 + 1/2 sum zeta_ij (b_ij - b*_ij)^2), means over the triangle, J
///
/// Means are of numbers by a: neighbours' coordinates have to run the same way, as a grid's and those along a fibre do.
/// Bisection at longest edges: Rivara 1984, Int. J. Numer. Meth. Eng. 20(4); no angle becomes smaller than half the
/// smallest. Estimate: Zienkiewicz & Zhu 1987, Int. J. Numer. Meth. Eng. 24(2).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "risorius/solve/motion_system.h"
#include "risorius/tissue/refine.h"
#include "risorius/tissue/triangle_sheet.h"

namespace risorius::tissue {

struct Bisected {
    TriangleSurface surface;                    ///< the former nodes first
    std::vector<std::array<int, 2>> middle_of;  ///< each further node lies between two others
    std::vector<int> parent;                    ///< of each triangle: the one it is part of
};

/// Cuts every marked triangle in two through the middle of its longest edge, and others where that is needed so that no
/// node lies within an edge. Ties of length go to the lower nodes.
Bisected bisected(const TriangleSurface& surface, const std::vector<char>& marked);

/// eta_t^2 of every triangle, J. `term` is the surface's.
Eigen::VectorXd squared_error(const TriangleSurface& surface, const TriangleSheetTerm& term,
                              const Points& x);

struct SurfaceRefineOptions {
    /// As of solids: estimated error in the energy norm, share of that of the deformation.    (0, 1)
    double tolerance = 0.1;
    int max_bisections = 4;  ///< of one triangle; two halve its edges    [0, 16]
};

class AdaptiveSurface {
  public:
    /// `surface` has passed check(). Throws std::invalid_argument for options outside their ranges.
    AdaptiveSurface(TriangleSurface surface, const SurfaceRefineOptions& options);

    const TriangleSurface& surface() const { return surface_; }
    const std::shared_ptr<TriangleSheetTerm>& term() const { return term_; }

    /// At rest on the present mesh.
    solve::MotionState start() const;

    /// Bisects every triangle for which `wanted`, once. A state given is carried over. True when anything changed.
    bool refine_where(const std::function<bool(int triangle)>& wanted,
                      solve::MotionState* state = nullptr);

    /// Bisects as the strain of `state` asks; new nodes lie in the middles of edges. Systems and terms of the former
    /// surface must be made anew when it returns true. Triangles are not put together again.
    bool refine(solve::MotionState& state);

    double estimated_error() const { return error_; }  ///< of the last refine(), as of solids

  private:
    bool bisect(const std::vector<char>& marked, solve::MotionState* state);

    TriangleSurface surface_;
    SurfaceRefineOptions options_;
    std::vector<int> bisections_;  ///< of each triangle since the first mesh
    std::shared_ptr<TriangleSheetTerm> term_;
    double error_ = 0;
};

/// As SettleSolid.
using SolveSurface = std::function<bool(const AdaptiveSurface& surface, SolveStage stage,
                                        solve::MotionState& state)>;

/// As of solids.
RefineRounds solve_and_refine(AdaptiveSurface& surface, const SolveSurface& solve, int rounds,
                              solve::MotionState& state);

}  // namespace risorius::tissue
