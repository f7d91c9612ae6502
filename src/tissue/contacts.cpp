#include "tissue/contacts.h"

#include <algorithm>
#include <utility>

#include "solve/hessian_builder.h"

namespace risorius::tissue {

void Contacts::set(std::vector<Contact> contacts) { contacts_ = std::move(contacts); }

double Contacts::gap(const Contact& contact, const Points& x) {
    Vec3 d = x.row(contact.node).transpose() - contact.point;
    for (int i = 0; i < contact.count; ++i)
        d -= contact.weights[i] * x.row(contact.others[i]).transpose();
    return d.dot(contact.normal);
}

double Contacts::add_energy(const Points& x, Points& gradient) const {
    double energy = 0;
    for (const Contact& contact : contacts_) {
        const double depth = gap(contact, x) - contact.rest_gap_m;
        if (depth >= 0) continue;
        energy += 0.5 * contact.stiffness_n_per_m * depth * depth;
        const Vec3 push = contact.stiffness_n_per_m * depth * contact.normal;
        gradient.row(contact.node) += push.transpose();
        for (int i = 0; i < contact.count; ++i)
            gradient.row(contact.others[i]) -= contact.weights[i] * push.transpose();
    }
    return energy;
}

void Contacts::add_hessian(const Points& x, solve::HessianBuilder& hessian) const {
    for (const Contact& contact : contacts_) {
        const bool apart = gap(contact, x) >= contact.rest_gap_m;
        const Mat3 block =
            (apart ? 0.0 : contact.stiffness_n_per_m) * contact.normal * contact.normal.transpose();
        hessian.add(contact.node, contact.node, block);
        for (int i = 0; i < contact.count; ++i) {
            hessian.add(contact.node, contact.others[i], -contact.weights[i] * block);
            for (int j = 0; j <= i; ++j)
                hessian.add(contact.others[i], contact.others[j],
                            contact.weights[i] * contact.weights[j] * block);
        }
    }
}

double Contacts::max_penetration(const Points& x) const {
    double deepest = 0;
    for (const Contact& contact : contacts_)
        deepest = std::max(deepest, contact.rest_gap_m - gap(contact, x));
    return deepest;
}

void add_metric_nodes(solve::MetricBuilder& builder, const std::vector<int>& nodes,
                      double stiffness_n_per_m) {
    for (const int node : nodes) builder.add_diagonal(node, stiffness_n_per_m);
}

}  // namespace risorius::tissue
