// SPDX-License-Identifier: MIT
/// \file
/// The energy of the volume muscles, and of the springs that bind the tissue to them.
#pragma once

#include "risorius/face/muscle/detail/muscle_solids.h"
#include "risorius/face/solver/detail/face_terms.h"

namespace risorius::face {

/// The volume muscles as a term of the face.
class VolumeMuscleTerm : public FaceTerm {
  public:
    /// Keeps references.
    VolumeMuscleTerm(MuscleSolids& solids, const TermInputs& inputs)
        : solids_(solids), inputs_(inputs) {}
    void begin_step(double t_s, double step_s, const Points& x, const Points& v) override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    void set_boundary_conditions(const BoundaryState& boundary) override;
    void move_mandible(const Rigid& mandible) override;
    void carry(Points& x, const Rigid& from, const Rigid& to) const override;
    void add_mandible_gradient(const Rigid& mandible, const Points& x, const Points& gradient,
                               Wrench& sum) const override;
    std::unique_ptr<LocalTerm> restricted_to(LocalNodes& nodes) const override;

  private:
    MuscleSolids& solids_;
    mutable Wrenches pull_;  // of the muscles on skull and mandible, at the last evaluation
    const TermInputs& inputs_;
};

}  // namespace risorius::face
