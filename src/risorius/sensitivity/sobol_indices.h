// SPDX-License-Identifier: MIT
/// \file
/// Sobol indices: which part of the variance of a result comes from each of its parameters, alone and together with others.
///
///   first order  S_i  = V(E(y | p_i)) / V         what would go away if p_i were known
///   total        S_Ti = E(V(y | p_~i)) / V        what would stay if all others were known
///
/// They are estimated from two independent samples A and B of the parameters, N rows each, and AB_i: A with the parameter i (or a group of
/// them) from B.
///
///   S_i  = 1/N sum y_B (y_ABi - y_A) / V          Saltelli et al. 2010, Comput. Phys. Commun. 181, 259-270
///   S_Ti = 1/(2N) sum (y_A - y_ABi)^2 / V         Jansen 1999, Comput. Phys. Commun. 117, 35-43
///
/// y is less its mean. A result with several components (a point in space) has one index of each kind: sums of the components above and
/// below the line (Gamboa et al. 2014, Electron. J. Stat. 8, 575-603).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace risorius::sensitivity {

/// An estimate, and the interval in which 95 % of its bootstrap replicates lie.
struct Estimate {
    double value = 0, low = 0, high = 0;
};

struct SobolIndices {
    Estimate first, total;
};

/// Results at the rows of the samples, N x components each.
struct SampledResults {
    Eigen::MatrixXd a, b;
    std::vector<Eigen::MatrixXd> ab;  ///< one for each parameter
};

struct IndexOptions {
    int replicates = 400;  ///< of the bootstrap, over rows
    std::uint64_t seed = 1;
};

/// Returns the indices of every parameter. All are NaN when the result does not vary.
std::vector<SobolIndices> sobol_indices(const SampledResults& results,
                                        const IndexOptions& options = {});

/// Returns the value below which a fraction of the values lies, linear between neighbours; NaN when there are no values.
double quantile_of(std::vector<double> values, double fraction);

}  // namespace risorius::sensitivity
