// SPDX-License-Identifier: MIT
/// \file
/// Contact between single nodes and planes, with the pairs and normals frozen by the caller for the length of a solve:
/// searching them anew inside the energy breaks its line search.
///
///   gap = (x_a - sum w_i x_i - p) . n     d = gap - g - s     E = kc/2 min(0, d)^2 + Es(gap)
///
/// The plane is carried by up to four other nodes with weights w (p is then the constant offset from
/// them, usually zero), or by none and p is a point of it. g is the rest gap min(0, gap at rest), so
/// that rest is free of force. s is the shift of an augmented Lagrangian: after every solve it grows by half of what is
/// left of the penetration, by less the farther it has come, so that steps on end press as hard as they must without a
/// stiffness that would slow the solver.
/// Contacts that harden have E = kc/(3 h) |d|^3 for d < 0 instead: as firm at d = -h, firmer below, and without the kink at
/// touching on which Newton's method stumbles.
///
/// Es: what was pressed together sticks a little. Opened by u dc beyond where it was let go, it pulls with
///   T = Tmax 27/4 u (1-u)^2,   0 < u < 1,   Tmax at u = 1/3
/// and is free from u = 1 on. Held open it flows: from solve to solve the pull fades.
#pragma once

#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {
class HessianBuilder;
}

namespace risorius::tissue {

class Contacts {
  public:
    struct Contact {
        int node = 0;  ///< a
        int others[4] = {0, 0, 0, 0};
        double weights[4] = {0, 0, 0, 0};  ///< of the others, sum 1
        int count = 0;                     ///< of the others, 0..4
        Vec3 point = Vec3::Zero();         ///< p, m
        Vec3 normal = Vec3::UnitZ();       ///< n, length 1, towards node a
        double rest_gap_m = 0;             ///< g <= 0
        double stiffness_n_per_m = 0;      ///< kc
        int body = 0;         ///< what p rides on or belongs to, as the caller counts bodies
        double fraction = 1;  ///< how far the plane stands for what is there, [0, 1]
        int slot = -1;  ///< names the contact from one list to the next; -1: it is not remembered
        double stick_n = 0;                ///< Tmax; 0: it does not stick
        double stick_m = 0;                ///< dc
        double shift_m = 0;                ///< s >= 0, from memory
        double hardens_m = 0;              ///< h; 0: the law is linear
        std::optional<double> let_go_m{};  ///< gap from which on it sticks, from memory
    };

    /// What is remembered of slots in `contacts` is put into them; of others it is forgotten.
    void set(std::vector<Contact> contacts);
    const std::vector<Contact>& list() const { return contacts_; }
    std::vector<Contact>& list() { return contacts_; }

    /// After a solve that ended at x: presses harder where something is left, and remembers what sticks.
    void remember(const Points& x);
    void forget() { memory_.clear(); }

    /// For solvers that know the second derivative: the same list without memory, hardening with depth.
    void set_firm(std::vector<Contact> contacts, double hardens_m);
    /// After such a solve: what makes the next list from set() press as hard.
    void remember_firm(const Points& x);

    static double gap(const Contact& contact, const Points& x);  ///< m
    /// dE/dgap, N: < 0 pushes apart, > 0 sticks.
    static double pull_n(const Contact& contact, const Points& x);

    /// Returns E(x), J, and adds dE/dx to `gradient`, n x 3, N.
    double add_energy(const Points& x, Points& gradient) const;

    /// Penetration beyond the one at rest as far as the plane stands, m; <= 0 when it does not touch.
    static double depth(const Contact& contact, const Points& x) {
        return contact.fraction * (contact.rest_gap_m - gap(contact, x));
    }

    /// Adds the second derivative at x but for what sticks, which has no negative part then; pairs apart are named too, so that the pattern does not
    /// hang on what touches.
    void add_hessian(const Points& x, solve::HessianBuilder& hessian) const;

    /// The deepest penetration beyond the one at rest, m; 0 when nothing touches.
    double max_penetration(const Points& x) const;

  private:
    struct Memory {
        int slot;
        double shift_m;
        std::optional<double> let_go_m;
    };
    std::vector<Contact> contacts_;
    std::vector<Memory> memory_;  // ascending slots
};

/// Pairs change from step to step but the metric must not: every node that may ever touch gets
/// `stiffness` on its diagonal.
void add_metric_nodes(solve::MetricBuilder& builder, const std::vector<int>& nodes,
                      double stiffness_n_per_m);

}  // namespace risorius::tissue
