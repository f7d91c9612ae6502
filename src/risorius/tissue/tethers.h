// SPDX-License-Identifier: MIT
/// \file
/// Attachment of tissue to what lies beneath it (retaining ligaments, periosteum, sliding fascia) by zero-length springs. A
/// spring pulls one node x to a target t. It is stiff along a normal n and soft across it. Targets and normals may be moved
/// between steps.
///
///   E = 1/2 [ kn ((x - t).n)^2 + kt |x - t - ((x - t).n) n|^2 ]
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
    struct Tether {
        int node = 0;
        Vec3 target = Vec3::Zero();   ///< t, m
        Vec3 normal = Vec3::UnitZ();  ///< n, length 1
        double kn_n_per_m = 0;        ///< along n     [0, inf)
        double kt_n_per_m = 0;        ///< across n    [0, inf)
    };

    explicit ZeroLengthSprings(std::vector<Tether> tethers);

    std::vector<Tether>& list() { return tethers_; }
    const std::vector<Tether>& list() const { return tethers_; }

    /// Returns E(x), J, and adds dE/dx to `gradient`, n x 3, N.
    double add_energy(const Points& x, Points& gradient) const;

    /// Adds the second derivative, N/m. It has no negative part.
    void add_hessian(solve::HessianBuilder& hessian) const;

    /// Adds max(kn, kt) to the diagonal: a bound for any direction of the normal.
    void add_metric(solve::MetricBuilder& builder) const;

  private:
    std::vector<Tether> tethers_;
};

}  // namespace risorius::tissue
