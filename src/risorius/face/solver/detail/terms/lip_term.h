// SPDX-License-Identifier: MIT
/// \file
/// The energy of the volume effect of orbicularis oris, see lip_drive.h.
#pragma once

#include "risorius/face/muscle/detail/lip_drive.h"
#include "risorius/face/solver/detail/face_terms.h"

namespace risorius::face {

/// The volume effect as a term of the face.
class LipTerm : public FaceTerm {
  public:
    /// Keeps references. Each evaluation sets the activation of `lips`.
    LipTerm(LipDrive& lips, const TermInputs& inputs) : lips_(lips), inputs_(inputs) {}
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
    LipDrive& lips_;
    const TermInputs& inputs_;
};

}  // namespace risorius::face
