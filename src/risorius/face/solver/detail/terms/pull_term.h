// SPDX-License-Identifier: MIT
/// \file
/// The springs by which hands hold the skin (Dobsik 2005, section 3.4), with their dampers and a largest force.
///
///   p  the point, m    o  where the hand is, m    d = |p - o|    k  stiffness, N/m    c  damping, N s/m    F  largest force, N
///   E = k/2 d^2 up to d = F/k, and F (d - F/(2k)) beyond;   h R = c/(2h) |p - p_n|^2
///
/// The matrices that are factored once (FaceTissue::prepare) do not contain them, so that a pull may begin at any step.
#pragma once

#include <memory>
#include <vector>

#include "risorius/face/solver/detail/face_terms.h"

namespace risorius::face {

/// The springs as a term of the face.
class PullTerm : public FaceTerm {
  public:
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double, solve::MetricBuilder&) const override {}
    void set_boundary_conditions(const BoundaryState& boundary) override {
        springs_ = boundary.pulls;
    }
    std::unique_ptr<LocalTerm> restricted_to(LocalNodes& nodes) const override;

  private:
    std::vector<PullSpring> springs_;
};

}  // namespace risorius::face
