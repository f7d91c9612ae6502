// SPDX-License-Identifier: MIT
/// \file
/// Equilibria of a face whose bones, lids and air are held: positions at which the static energy of FaceTissue has no slope,
/// and what is linear around them.
///
///   g(x) = dE/dx      H = d2E/dx2      B = H^-1 as last factored, there or nearby, without negative curvature
///
/// L-BFGS with B as its metric: its first iteration is Newton's, the next ones correct B for where they are. Contact pairs are
/// found anew before each round of iterations and hold within it. B is factored anew when a round gains too little. Nodes that
/// keep snapping between the planes of two rounds are held by springs to where the round began: without force at rest.
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

class StaticSolver {
  public:
    /// Keeps a reference.
    explicit StaticSolver(FaceTissue& tissue);
    ~StaticSolver();

    /// Moves x to the equilibrium; the tissue must be prescribed, and x's fixed rows in place. Finds contacts.
    StepStats solve_equilibrium(const Eigen::VectorXd& activation, const StaticOptions& options,
                                Points& x);

    /// Factors H at x with the contacts as they are; an exact one that is not positive gives way to its positive part.
    void factorise(const Points& x, const Eigen::VectorXd& activation, solve::Curvature first);
    /// y = H^-1 b, n x 3 each, with the last factor; fixed rows of y are zero.
    void solve(const Points& b, Points& y) const;
    /// The next solve_equilibrium() does not begin with the last factor: what it finds depends on its arguments alone.
    void forget() {
        known_ = false;
        touched_
            .clear();  // the order in which a matrix is eliminated tells what was in contact before
    }

    long factors() const { return factors_; }  ///< made so far

  private:
    struct Linear;
    /// Moves x near the equilibrium, unless it is there.
    void approach(const Eigen::VectorXd& activation, const StaticOptions& options, Points& x,
                  StepStats& figures);
    /// Springs for nodes that are farther from where contacts were sought, stiffer ones for those that do not come nearer.
    /// Says whether any is new or stiffer.
    bool hold_what_moved(const Points& x, double more_than_m);
    double energy(const Points& x, const Eigen::VectorXd& activation, Points& gradient);

    FaceTissue& tissue_;
    std::unique_ptr<Linear> linear_;
    bool known_ = false;
    long factors_ = 0;
    std::vector<std::pair<int, int>> touched_;  ///< nodes of pairs that were in contact, sorted
    solve::QuasiNewton search_;
    Points sought_;  ///< where contacts were found
    struct Spring {  ///< to sought_
        int node;
        double n_per_m;
        double away_m;  ///< where the last round took it
    };
    std::vector<Spring> springs_;  ///< ascending nodes
    Points gradient_, move_;
};

}  // namespace risorius::face
