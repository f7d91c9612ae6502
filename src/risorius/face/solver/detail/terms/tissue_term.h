// SPDX-License-Identifier: MIT
/// \file
/// The elastic energy of the tetrahedra of the tissue, with viscous damping in time steps.
#pragma once

#include "risorius/face/solver/detail/face_terms.h"
#include "risorius/tissue/tet_solid.h"

namespace risorius::face {

/// The tetrahedra as a term of the face.
class TissueTerm : public FaceTerm {
  public:
    /// Keeps references. `damping_s` is beta in face_tissue.h.
    TissueTerm(tissue::TetSolid& tets, double damping_s, const TermInputs& inputs)
        : tets_(tets), damping_s_(damping_s), inputs_(inputs) {}
    void begin_step(double t_s, double step_s, const Points& x, const Points& v) override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    std::unique_ptr<LocalTerm> restricted_to(LocalNodes& nodes) const override;

  private:
    tissue::TetSolid& tets_;
    double damping_s_;
    const TermInputs& inputs_;
};

}  // namespace risorius::face
