// SPDX-License-Identifier: MIT
/// \file
/// Chooses few units and muscles whose displacements sum to a target, from a linear model of all of them.
///
///   minimise over sets S and 0 <= w <= 1   1/2 |u0 + J w - g|^2 / |g|^2 + ridge/2 |w|^2 + sum_i price w_i + sum of the costs of S,
///   w = 0 outside S
///
/// S costs a little more for each of its units that is a stranger to the expression that has most of them, so that of two sets that do
/// equally well the one is chosen that people show.
///
/// Candidates are added one after the other, each the one that helps most. Then a candidate is exchanged for another, or left out, as long
/// as that helps. Faults of the first choices do not stay as with a greedy choice.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/inverse/detail/unit_model.h"
#include "risorius/inverse/detail/unit_sources.h"

namespace risorius::inverse {

struct UnitChoiceOptions {
    int most = 8;          ///< maximum number of candidates
    double unit_cost = 0;  ///< times that of the candidate, relative to |g|^2 / 2
    double ridge = 1e-6, price = 1e-5;
};

/// The weights of sources, and which of them are chosen.
struct UnitChoice {
    std::vector<bool> active;  ///< one per source
    Eigen::VectorXd weight;
    double objective = 0;
};

/// Weights of the active sources that lead a tangent to the goal, each within `step` of `at`. With `keep` > 0 they stay near `expected`:
/// keep/2 |w - expected|^2.
struct UnitFit {
    double size = 1;  ///< |g|^2
    double ridge = 1e-6;
    Eigen::VectorXd price;
    double keep = 0;
    Eigen::VectorXd expected = {};
    double step = 1;
};
Eigen::VectorXd fit_weights(const UnitModel::Tangent& tangent, const Eigen::VectorXd& goal,
                            const std::vector<bool>& active, const Eigen::VectorXd& at,
                            const UnitFit& how);

UnitChoice choose_units(const UnitModel::Tangent& tangent, const Eigen::VectorXd& goal,
                        const UnitSources& sources, const UnitChoiceOptions& options);

}  // namespace risorius::inverse
