// SPDX-License-Identifier: MIT
/// \file
/// The energy of the muscle fibres in bundles, for their active and passive force. Some points of the fibres lie on bone.
#pragma once

#include "risorius/face/solver/detail/face_terms.h"
#include "risorius/muscle/fibre_set.h"

namespace risorius::face {

/// The fibres as a term of the face.
class FibreTerm : public FaceTerm {
  public:
    /// Keeps references. `hill` are the curves that the fibres were built with.
    FibreTerm(muscle::FibreSet& fibres, const muscle::HillShape& hill, const TermInputs& inputs)
        : fibres_(fibres), hill_(hill), inputs_(inputs) {}
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    void set_boundary_conditions(const BoundaryState& boundary) override;
    void move_mandible(const Rigid& mandible) override;
    void add_mandible_gradient(const Rigid& mandible, const Points& x, const Points& gradient,
                               Wrench& sum) const override;
    std::unique_ptr<LocalTerm> restricted_to(LocalNodes& nodes) const override;

  private:
    muscle::FibreSet& fibres_;
    const muscle::HillShape& hill_;
    const TermInputs& inputs_;
};

}  // namespace risorius::face
