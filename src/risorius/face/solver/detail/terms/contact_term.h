// SPDX-License-Identifier: MIT
/// \file
/// The energy of the contact pairs: lips, bone, teeth and eyeballs.
#pragma once

#include <vector>

#include "risorius/face/solver/detail/contact_search.h"
#include "risorius/face/solver/detail/face_terms.h"
#include "risorius/tissue/contacts.h"

namespace risorius::face {

/// The contacts as a term of the face.
class ContactTerm : public FaceTerm {
  public:
    /// Keeps references.
    ContactTerm(tissue::Contacts& contacts, const ContactSearch& search)
        : contacts_(contacts), search_(search) {}
    /// Notes where the points of the contacts lie on the mandible. Call it after each change of the list of contacts. `mandible` is
    /// the motion of the mandible from rest.
    void note(const Rigid& mandible);
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    void move_mandible(const Rigid& mandible) override;
    void add_mandible_gradient(const Rigid& mandible, const Points& x, const Points& gradient,
                               Wrench& sum) const override;
    std::unique_ptr<LocalTerm> restricted_to(LocalNodes& nodes) const override;

  private:
    tissue::Contacts& contacts_;
    const ContactSearch& search_;
    std::vector<Vec3> on_mandible_;  // per contact, its point with the mandible at rest, m
};

}  // namespace risorius::face
