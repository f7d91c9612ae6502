// SPDX-License-Identifier: MIT
/// \file
/// Contact between single nodes and planes. The caller fixes the pairs and normals for the length of a solve, because searching
/// for them inside the energy would break the line search.
///
///   gap = (x_a - sum w_i x_i - p) . n     d = gap - g - s     E = kc/2 min(0, d)^2 + Es(gap)
///
/// The plane is carried by up to four other nodes with weights w; then p is a constant offset from them, usually zero. Or it is
/// carried by none; then p is a point of the plane. g is the rest gap, min(0, gap in the rest pose), so that the rest pose is
/// free of force.
///
/// s is the shift of an augmented Lagrangian. After every solve it grows by half of the remaining penetration, and by less the
/// larger it already is. Over several steps contacts come to press as hard as they must, without a stiffness that would slow the
/// solver down.
///
/// Contacts that harden have E = kc/(3 h) |d|^3 for d < 0 instead. Their force equals that of the linear law at d = -h and is
/// larger for deeper contact. They have no kink at first touch, on which Newton's method would stall.
///
/// Es is adhesion. A contact that was pressed together and has opened by u dc beyond the gap at which it was released pulls
/// with
///   T = Tmax 27/4 u (1-u)^2,   0 < u < 1,   Tmax at u = 1/3
/// and is free from u = 1 on. While it is held open, the pull fades from solve to solve.
#pragma once

#include <optional>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {
class HessianBuilder;
}

namespace risorius::tissue {

/// The list of contacts, their energy, and the memory of shifts and adhesion.
class Contacts {
  public:
    struct Contact {
        int node = 0;  ///< a
        int others[4] = {0, 0, 0, 0};
        double weights[4] = {0, 0, 0, 0};  ///< of the others, sum 1
        int count = 0;                     ///< number of other nodes, 0..4
        Vec3 point = Vec3::Zero();         ///< p, m
        Vec3 normal = Vec3::UnitZ();       ///< n, length 1, towards node a
        double rest_gap_m = 0;             ///< g <= 0
        double stiffness_n_per_m = 0;      ///< kc
        int body = 0;                      ///< the body that p belongs to, numbered by the caller
        /// Weight of the plane, [0, 1]: how far it represents the real surface.
        double fraction = 1;
        int slot = -1;  ///< identifies the contact across lists; -1: nothing is remembered of it
        double stick_n = 0;                ///< Tmax; 0: no adhesion
        double stick_m = 0;                ///< dc
        double shift_m = 0;                ///< s >= 0, from memory
        double hardens_m = 0;              ///< h; 0: the law is linear
        std::optional<double> let_go_m{};  ///< gap at which adhesion begins, from memory
    };

    /// Replaces the list. Contacts whose slot is in memory get their remembered shift and release gap back.
    void set(std::vector<Contact> contacts);
    const std::vector<Contact>& list() const { return contacts_; }
    std::vector<Contact>& list() { return contacts_; }

    /// To be called after a solve that ended at `x`: updates the shifts and the adhesion. The memory then has only the slots of
    /// this list.
    void remember(const Points& x);
    void forget() { memory_.clear(); }

    /// For solvers that use second derivatives: the same list without memory, with contacts that harden with depth.
    void set_firm(std::vector<Contact> contacts, double hardens_m);
    /// To be called after such a solve: updates the memory so that the next list from set() presses as hard.
    void remember_firm(const Points& x);

    static double gap(const Contact& contact, const Points& x);  ///< m
    /// dE/dgap, N. Negative values push the sides apart, positive values pull them together.
    static double pull_n(const Contact& contact, const Points& x);

    /// Returns E(x), J, and adds dE/dx to `gradient`, n x 3, N.
    double add_energy(const Points& x, Points& gradient) const;

    /// Penetration beyond that of the rest pose times the weight of the plane, m; <= 0 without contact.
    static double depth(const Contact& contact, const Points& x) {
        return contact.fraction * (contact.rest_gap_m - gap(contact, x));
    }

    /// Adds the second derivative at x, except that of adhesion, so the result has no negative part. Open pairs are added too,
    /// so that the sparsity pattern does not depend on which contacts touch.
    void add_hessian(const Points& x, solve::HessianBuilder& hessian) const;

    /// Maximum penetration beyond that of the rest pose, m; 0 without contact.
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

/// Adds `stiffness_n_per_m` to the diagonal of every node that may ever touch something. Pairs change from step to step, but
/// the metric must not.
void add_metric_nodes(solve::MetricBuilder& builder, const std::vector<int>& nodes,
                      double stiffness_n_per_m);

}  // namespace risorius::tissue
