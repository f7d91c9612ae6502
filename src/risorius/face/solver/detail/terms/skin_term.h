// SPDX-License-Identifier: MIT
/// \file
/// The elastic energy of the skin: membrane and bending of its triangles.
#pragma once

#include "risorius/face/solver/detail/face_terms.h"
#include "risorius/tissue/skin_sheet.h"

namespace risorius::face {

/// The data from which a SkinSheet is built.
struct SkinSheetParts {
    Triangles triangles;               ///< F x 3 nodes
    Eigen::VectorXd membrane_n_per_m;  ///< per triangle
    Eigen::VectorXd bending_n_m;       ///< per triangle
};

/// The skin as a term of the face.
class SkinTerm : public FaceTerm {
  public:
    /// Keeps references. `skin` must have been built from `parts`.
    SkinTerm(const tissue::SkinSheet& skin, const SkinSheetParts& parts, const TermInputs& inputs)
        : skin_(skin), parts_(parts), inputs_(inputs) {}
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    std::unique_ptr<LocalTerm> restricted_to(LocalNodes& nodes) const override;

  private:
    const tissue::SkinSheet& skin_;
    const SkinSheetParts& parts_;
    const TermInputs& inputs_;
};

}  // namespace risorius::face
