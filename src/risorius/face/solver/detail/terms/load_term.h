// SPDX-License-Identifier: MIT
/// \file
/// Dead loads, which do not depend on the positions: air pressure in the cheeks, and the change of the weight of the tissue when the
/// head tilts.
#pragma once

#include <utility>
#include <vector>

#include "risorius/face/solver/detail/face_terms.h"
#include "risorius/tissue/dead_loads.h"

namespace risorius::face {

/// The loads as a term of the face.
class LoadTerm : public FaceTerm {
  public:
    /// Keeps references. `cheeks`: deep nodes, each with its area vector (outwards, m^2); `mass_kg` and `fixed`: per node.
    LoadTerm(const std::vector<std::pair<int, Vec3>>& cheeks, const Eigen::VectorXd& mass_kg,
             const std::vector<char>& fixed)
        : cheeks_(cheeks), mass_kg_(mass_kg), fixed_(fixed) {}
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep&, const Points&, solve::Curvature,
                     solve::HessianBuilder&) const override {}
    void add_metric(double, solve::MetricBuilder&) const override {}
    void set_boundary_conditions(const BoundaryState& boundary) override;
    std::unique_ptr<LocalTerm> restricted_to(LocalNodes& nodes) const override;

  private:
    const std::vector<std::pair<int, Vec3>>& cheeks_;
    const Eigen::VectorXd& mass_kg_;
    const std::vector<char>& fixed_;
    tissue::DeadLoads loads_;
};

}  // namespace risorius::face
