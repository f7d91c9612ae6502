// SPDX-License-Identifier: MIT
/// \file
/// Nodes that keep one or two of their coordinates, as on a plane along which they slide: by springs that are so stiff that they hardly
/// give way. They suit implicit steps and equilibria; explicit steps would have to be very short.
///
///     E = sum over guides of k (x_i[axis] - rest_i[axis])^2 / 2          k  stiffness, N/m
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/energy_term.h"

namespace risorius::tissue {

class CoordinateGuides final : public solve::EnergyTerm {
  public:
    struct Guide {
        int node = 0;
        int axis = 0;     ///< 0, 1 or 2
        double at_m = 0;  ///< the coordinate that it keeps
    };

    CoordinateGuides(std::vector<Guide> guides, double stiffness_n_per_m)
        : guides_(std::move(guides)), stiffness_n_per_m_(stiffness_n_per_m) {}

    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    double force_n(const Guide& guide, const Points& x) const {  ///< on the node, along the axis
        return stiffness_n_per_m_ * (guide.at_m - x(guide.node, guide.axis));
    }

  private:
    std::vector<Guide> guides_;
    double stiffness_n_per_m_;
};

}  // namespace risorius::tissue
