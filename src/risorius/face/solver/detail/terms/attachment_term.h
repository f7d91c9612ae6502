// SPDX-License-Identifier: MIT
/// \file
/// Springs that hold the deep tissue to bone, and the lids to their tarsal plates.
#pragma once

#include <vector>

#include "risorius/face/anatomy/detail/attachments.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/solver/detail/face_terms.h"
#include "risorius/tissue/zero_length_springs.h"

namespace risorius::face {

/// The end of one spring of a lid on the tarsal plate.
struct LidSpring {
    int side;  ///< 0 left, 1 right
    LidMember member;
    Vec3 rest;  ///< position at rest, m
};

/// These springs as a term of the face.
class AttachmentTerm : public FaceTerm {
  public:
    /// Keeps references. `springs` has one entry per attachment, then one per lid spring.
    AttachmentTerm(std::vector<tissue::ZeroLengthSprings::Spring> springs,
                   std::vector<LidSpring> lid_springs, const std::vector<Attachment>& attachments,
                   const TissueMesh& mesh, const Jaw& jaw, const std::array<EyeLids, 2>& lids);
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    void set_boundary_conditions(const BoundaryState& boundary) override;
    void move_mandible(const Rigid& mandible) override;
    /// All nodes over an attachment follow the same fraction of the mandible's motion as the attachment.
    void carry(Points& x, const Rigid& from, const Rigid& to) const override;
    void add_mandible_gradient(const Rigid& mandible, const Points& x, const Points& gradient,
                               Wrench& sum) const override;
    std::unique_ptr<LocalTerm> restricted_to(LocalNodes& nodes) const override;

  private:
    tissue::ZeroLengthSprings springs_;
    std::vector<LidSpring> lid_springs_;
    const std::vector<Attachment>& attachments_;
    const TissueMesh& mesh_;
    const Jaw& jaw_;
    const std::array<EyeLids, 2>& lids_;
};

}  // namespace risorius::face
