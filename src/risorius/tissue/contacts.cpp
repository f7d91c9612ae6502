// SPDX-License-Identifier: MIT
#include "risorius/tissue/contacts.h"

#include <algorithm>
#include <utility>

#include "risorius/solve/hessian_builder.h"

namespace risorius::tissue {

namespace {

// Limit of the shift. A contact that cannot be resolved must not press ever harder, or it would leap when it is released. Lips
// that press with full strength need 4 mm of shift (20 kPa at the contact stiffness of a face). A large shift grows slowly,
// because lips that are held in an impossible position would oscillate. It shrinks at full speed, because lips that part would
// be pushed on otherwise.
constexpr double kMaxShift_m = 6e-3;
constexpr double kQuickShift_m = 2e-3;  // at this shift, growth is half as fast
// Fraction of the penetration that the shift takes up per solve. With 1, lips that meet in full motion leap apart by a
// millimetre, at a time that depends on how far the solve has come.
constexpr double kLearning = 0.5;
constexpr double kFlow = 0.05;  // fraction of its opening by which adhesion yields per solve
// Fraction of the open gap by which the shift shrinks per solve.
constexpr double kForgetting = 0.25;

// The fraction u of dc by which a contact with adhesion has opened; 0 when it does not pull.
double opened(const Contacts::Contact& contact, double gap) {
    if (!contact.let_go_m || contact.stick_n <= 0) return 0;
    return std::clamp((gap - *contact.let_go_m) / contact.stick_m, 0.0, 1.0);
}

// E, dE/dd and d2E/dd2 of a contact with penetration d > 0.
struct Pressed {
    double energy_j, force_n, stiffness_n_per_m;
};
Pressed pressed(const Contacts::Contact& contact, double d) {
    const double k = contact.stiffness_n_per_m;
    if (contact.hardens_m <= 0) return {0.5 * k * d * d, k * d, k};
    const double per_m = k / contact.hardens_m;
    return {per_m * d * d * d / 3, per_m * d * d, 2 * per_m * d};
}

}  // namespace

void Contacts::set(std::vector<Contact> contacts) {
    contacts_ = std::move(contacts);
    for (Contact& contact : contacts_) {
        if (contact.slot < 0) continue;
        const auto known =
            std::lower_bound(memory_.begin(), memory_.end(), contact.slot,
                             [](const Memory& memory, int slot) { return memory.slot < slot; });
        if (known == memory_.end() || known->slot != contact.slot) continue;
        contact.shift_m = known->shift_m;
        contact.let_go_m = known->let_go_m;
    }
}

void Contacts::remember(const Points& x) {
    memory_.clear();
    for (Contact& contact : contacts_) {
        if (contact.slot < 0) continue;
        const double now = gap(contact, x), beyond = now - contact.rest_gap_m;
        // The shift falls more slowly than it rises, so that contacts that come and go do not oscillate.
        const double far = contact.shift_m / kQuickShift_m;
        const double change = beyond < 0 ? -kLearning * beyond / (1 + far * far)
                                         : -std::max(kForgetting * beyond, 1e-7);
        contact.shift_m = std::clamp(contact.shift_m + change, 0.0, kMaxShift_m);
        if (contact.stick_n > 0) {
            const double push = -pull_n(contact, x);
            if (push > 0.1 * contact.stick_n)
                contact.let_go_m = now;
            else if (contact.let_go_m && now > *contact.let_go_m + contact.stick_m)
                contact.let_go_m.reset();
            else if (contact.let_go_m)  // saliva flows, so a bridge does not pull forever
                *contact.let_go_m += kFlow * std::max(0.0, now - *contact.let_go_m);
        }
        if (contact.shift_m > 0 || contact.let_go_m)
            memory_.push_back({contact.slot, contact.shift_m, contact.let_go_m});
    }
    std::sort(memory_.begin(), memory_.end(),
              [](const Memory& a, const Memory& b) { return a.slot < b.slot; });
}

void Contacts::set_firm(std::vector<Contact> contacts, double hardens_m) {
    contacts_ = std::move(contacts);
    for (Contact& contact : contacts_) contact.hardens_m = hardens_m;
}

void Contacts::remember_firm(const Points& x) {
    memory_.clear();
    for (const Contact& contact : contacts_) {
        const double depth = contact.rest_gap_m - gap(contact, x);
        if (contact.slot < 0 || depth <= 0) continue;
        const double shift = pressed(contact, depth).force_n / contact.stiffness_n_per_m - depth;
        if (shift > 0)
            memory_.push_back({contact.slot, std::min(shift, kMaxShift_m), std::nullopt});
    }
    std::sort(memory_.begin(), memory_.end(),
              [](const Memory& a, const Memory& b) { return a.slot < b.slot; });
}

double Contacts::gap(const Contact& contact, const Points& x) {
    Vec3 d = x.row(contact.node).transpose() - contact.point;
    for (int i = 0; i < contact.count; ++i)
        d -= contact.weights[i] * x.row(contact.others[i]).transpose();
    return d.dot(contact.normal);
}

double Contacts::pull_n(const Contact& contact, const Points& x) {
    const double now = gap(contact, x);
    const double u = opened(contact, now);
    const double depth = contact.rest_gap_m + contact.shift_m - now;
    return (depth > 0 ? -pressed(contact, depth).force_n : 0.0) +
           contact.stick_n * 6.75 * u * (1 - u) * (1 - u);
}

double Contacts::add_energy(const Points& x, Points& gradient) const {
    double energy = 0;
    for (const Contact& contact : contacts_) {
        const double now = gap(contact, x);
        const double depth = contact.rest_gap_m + contact.shift_m - now;
        const double u = opened(contact, now);
        if (depth <= 0 && u <= 0) continue;
        double pull = 0;
        if (depth > 0) {
            const Pressed by = pressed(contact, depth);
            energy += by.energy_j;
            pull -= by.force_n;
        }
        if (u > 0) {
            energy += contact.stick_n * contact.stick_m * 6.75 * u * u *
                      (0.5 - u * (2.0 / 3.0 - 0.25 * u));
            pull += contact.stick_n * 6.75 * u * (1 - u) * (1 - u);
        }
        const Vec3 along = pull * contact.normal;
        gradient.row(contact.node) += along.transpose();
        for (int i = 0; i < contact.count; ++i)
            gradient.row(contact.others[i]) -= contact.weights[i] * along.transpose();
    }
    return energy;
}

void Contacts::add_hessian(const Points& x, solve::HessianBuilder& hessian) const {
    for (const Contact& contact : contacts_) {
        const double depth = contact.rest_gap_m + contact.shift_m - gap(contact, x);
        const double stiffness = depth > 0 ? pressed(contact, depth).stiffness_n_per_m : 0.0;
        const Mat3 block = stiffness * contact.normal * contact.normal.transpose();
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
    for (const Contact& contact : contacts_) deepest = std::max(deepest, depth(contact, x));
    return deepest;
}

void add_metric_nodes(solve::MetricBuilder& builder, const std::vector<int>& nodes,
                      double stiffness_n_per_m) {
    for (const int node : nodes) builder.add_diagonal(node, stiffness_n_per_m);
}

}  // namespace risorius::tissue
