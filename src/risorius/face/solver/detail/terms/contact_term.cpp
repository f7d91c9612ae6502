// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/terms/contact_term.h"

namespace risorius::face {

namespace {

constexpr double kEquilibriumContactFraction = 0.5;  // kContactFraction of equilibria

// Contacts with a moving node. Held nodes become part of the fixed place of a plane.
class LocalContacts : public LocalTerm {
  public:
    LocalContacts(const tissue::Contacts& whole, const ContactSearch& search)
        : whole_(whole), search_(search) {}
    void add_metric(const LocalNodes& nodes, double, solve::MetricBuilder& builder) const override {
        for (std::size_t i = 0; i < search_.nodes().size(); ++i)
            if (nodes.moves(search_.nodes()[i]))
                builder.add_diagonal(nodes.row(search_.nodes()[i]),
                                     kContactFraction * search_.node_stiffness()[i]);
    }
    void begin(const LocalNodes& nodes, const LocalStep&, const Points& x) override {
        std::vector<tissue::Contacts::Contact>& contacts = contacts_.list();
        contacts.clear();
        for (const tissue::Contacts::Contact& found : whole_.list()) {
            tissue::Contacts::Contact contact = found;
            contact.count = 0;
            bool moved = nodes.moves(found.node);
            for (int i = 0; i < found.count; ++i) {
                if (nodes.moves(found.others[i])) {
                    contact.others[contact.count] = nodes.row(found.others[i]);
                    contact.weights[contact.count++] = found.weights[i];
                    moved = true;
                } else {
                    contact.point += found.weights[i] * x.row(found.others[i]).transpose();
                }
            }
            contact.node = nodes.row(found.node);
            if (moved && contact.node >= 0) contacts.push_back(contact);
        }
    }
    void add_energy(const Points& at, double& value, Points& gradient) const override {
        value += contacts_.add_energy(at, gradient);
    }

  private:
    const tissue::Contacts& whole_;
    const ContactSearch& search_;
    tissue::Contacts contacts_;
};

}  // namespace

void ContactTerm::note(const Rigid& mandible) {
    on_mandible_.clear();
    const Rigid to_rest = mandible.inverse();
    for (const tissue::Contacts::Contact& contact : contacts_.list())
        on_mandible_.push_back(to_rest * contact.point);
}

double ContactTerm::add_potential(const solve::ImplicitStep&, const Points& x,
                                  Points& gradient) const {
    return contacts_.add_energy(x, gradient);
}

void ContactTerm::add_hessian(const solve::ImplicitStep&, const Points& x, solve::Curvature,
                              solve::HessianBuilder& hessian) const {
    contacts_.add_hessian(x, hessian);
}

void ContactTerm::add_metric(double step_s, solve::MetricBuilder& metric) const {
    const double fraction = step_s < kSettling_s ? kContactFraction : kEquilibriumContactFraction;
    for (std::size_t i = 0; i < search_.nodes().size(); ++i)
        metric.add_diagonal(search_.nodes()[i], fraction * search_.node_stiffness()[i]);
}

void ContactTerm::move_mandible(const Rigid& mandible) {
    for (std::size_t c = 0; c < contacts_.list().size(); ++c)
        if (contacts_.list()[c].body == kMandibleBody)
            contacts_.list()[c].point = mandible * on_mandible_[c];
}

void ContactTerm::add_mandible_gradient(const Rigid&, const Points& x, const Points&,
                                        Wrench& sum) const {
    for (const tissue::Contacts::Contact& contact : contacts_.list()) {
        if (contact.body != kMandibleBody) continue;
        sum.add(-tissue::Contacts::pull_n(contact, x) * contact.normal, contact.point);
    }
}

std::unique_ptr<LocalTerm> ContactTerm::restricted_to(LocalNodes&) const {
    return std::make_unique<LocalContacts>(contacts_, search_);
}

}  // namespace risorius::face
