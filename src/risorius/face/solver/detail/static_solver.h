// SPDX-License-Identifier: MIT
/// \file
/// Finds static equilibria of the tissue with fixed boundary conditions, and solves linear systems there.
///
///     g(x) = dE/dx = 0,   H = d2E/dx2
///
/// - E: static energy of FaceTissue, J; x: nodes, n x 3, m
/// - B: inverse of H as it was last factorised, at x or nearby, without negative curvature
///
/// The method is L-BFGS with the metric B. Its first iteration is a Newton step; later iterations correct B for the new positions.
/// Contact pairs are searched before each round of iterations and are fixed within it. H is factorised again when a round gains too
/// little. Some nodes keep snapping between the contact planes of two rounds. Springs hold them to their positions at the start of the
/// round; the springs exert no force in equilibrium.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/solver/detail/face_tissue.h"
#include "risorius/face/solver/detail/static_options.h"
#include "risorius/solve/quasi_newton.h"

namespace risorius::face {

/// The solver for one tissue.
class StaticSolver {
  public:
    /// Keeps a reference to the tissue.
    explicit StaticSolver(FaceTissue& tissue);
    ~StaticSolver();

    /// Moves x to the equilibrium and finds the contacts there. The boundary conditions must be set, and the fixed rows of x must be in
    /// place.
    StepStats solve_equilibrium(const Eigen::VectorXd& activation, const StaticOptions& options,
                                Points& x);

    /// Factorises H at x with the current contacts. `first` is the form of H that is tried first. If it is not positive definite, the
    /// positive part of H is factorised. `precision` is that of the factor: single is enough for the metric of a search.
    void factorise(const Points& x, const Eigen::VectorXd& activation, solve::Curvature first,
                   solve::Precision precision = solve::Precision::kSingle);
    /// Computes y = H^-1 b, n x 3 each, with the last factor. Fixed rows of y are zero.
    void solve(const Points& b, Points& y) const;
    /// Forgets the last factor, so that the result of the next solve_equilibrium() depends on its arguments alone. `near`: it begins in
    /// an equilibrium, so that H is factorised there at once.
    void forget(bool near = false);

    long factors() const { return factors_; }  ///< number of factorisations so far

  private:
    struct Linear;
    /// Orders the rows of H once, as if the lips touched at rest. The order depends on the face alone.
    void order(const Points& x, const Eigen::VectorXd& activation);
    /// Moves x near the equilibrium. Does nothing if x is near already.
    void approach(const Eigen::VectorXd& activation, const StaticOptions& options, Points& x,
                  StepStats& figures);
    /// Adds springs for nodes farther than `more_than_m` from the last contact search. Stiffens the springs of nodes that do not come
    /// nearer. Returns whether any spring is new or stiffer.
    bool hold_what_moved(const Points& x, double more_than_m);
    double energy(const Points& x, const Eigen::VectorXd& activation, Points& gradient);

    FaceTissue& tissue_;
    std::unique_ptr<Linear> linear_;
    bool known_ = false, near_ = false;
    long factors_ = 0;
    std::vector<std::pair<int, int>> touched_;  ///< nodes of pairs that were in contact, sorted
    solve::QuasiNewton search_;
    Points sought_;  ///< positions at the last contact search, n x 3, m
    struct Spring {  ///< holds a node to its row of sought_
        int node;
        double n_per_m;
        double away_m;  ///< distance from sought_ after the last round
    };
    std::vector<Spring> springs_;  ///< ascending nodes
    Points gradient_, move_;
};

}  // namespace risorius::face
