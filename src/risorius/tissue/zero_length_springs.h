// SPDX-License-Identifier: MIT
/// \file
/// Springs of rest length zero. They attach single nodes to targets in what lies below: retaining ligaments, periosteum, sliding
/// fascia. A spring has one stiffness along a normal and another across it.
///
///     E = sum over springs of 1/2 [ kn ((x - t) . n)^2 + kt |x - t - ((x - t) . n) n|^2 ]
///
/// - x: position of the node, m; t: target, m; n: normal, unit
/// - kn, kt: stiffness along and across the normal, N/m
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {
class HessianBuilder;
}

namespace risorius::tissue {

/// The list of springs and their energy.
class ZeroLengthSprings {
  public:
    struct Spring {
        int node = 0;
        Vec3 target = Vec3::Zero();   ///< t, m
        Vec3 normal = Vec3::UnitZ();  ///< n, unit
        double kn_n_per_m = 0;        ///< along n     [0, inf)
        double kt_n_per_m = 0;        ///< across n    [0, inf)
    };

    explicit ZeroLengthSprings(std::vector<Spring> springs);

    /// Targets and normals may change between evaluations.
    std::vector<Spring>& list() { return springs_; }
    const std::vector<Spring>& list() const { return springs_; }

    /// Returns E(x), J, and adds dE/dx to `gradient`, n x 3, N.
    double add_energy(const Points& x, Points& gradient) const;

    /// Adds the second derivative, N/m. It has no negative part.
    void add_hessian(solve::HessianBuilder& hessian) const;

    /// Adds max(kn, kt) to the diagonal: a bound for every direction of the normal.
    void add_metric(solve::MetricBuilder& builder) const;

  private:
    std::vector<Spring> springs_;
};

}  // namespace risorius::tissue
