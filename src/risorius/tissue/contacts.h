// SPDX-License-Identifier: MIT
/// \file
/// Contact between single nodes and planes. The caller fixes the pairs and normals for the whole of a solve: a search within
/// the energy would make it discontinuous, and the line search would fail.
///
///   gap = (x_a - sum w_i x_i - p) . n     d = gap - g - s     E = kc/2 min(0, d)^2 + Es(gap)
///
/// x_a is the node that touches, x_i are the other nodes and kc is the stiffness. The plane is carried by up to six other
/// nodes with weights w_i; then p is a constant offset from them. Or it is carried by none; then p is a point of the plane. n is
/// the normal of the plane. g is the rest gap, min(0, gap in the rest pose), so that the rest pose is free of force.
///
/// s is the shift of an augmented Lagrangian. After every solve it grows by half of the remaining penetration, or by less when
/// it is already large. Over several steps the contact force becomes large enough to prevent penetration, without a high
/// stiffness that would slow down the solver.
///
/// Contacts that harden have E = kc/(3 h) |d|^3 for d < 0 instead. Their force equals that of the linear law at d = -h, and is
/// larger for deeper penetration. The force has no kink where contact begins, at which Newton's method would stall.
///
/// Es is the energy of adhesion, J. The contact remembers the gap at which it was last pressed together. When it has opened by
/// u dc beyond this gap, the sides pull each other with the force T, N:
///   T = Tmax 27/4 u (1-u)^2,   0 < u < 1,   Tmax at u = 1/3
/// dc is the distance over which adhesion acts. From u = 1 on there is no force, and the remembered gap is deleted. While 0 < u
/// < 1, the remembered gap follows the contact by 5 percent of its opening per solve. So the pull of a contact that is held
/// open fades.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {
class HessianBuilder;
}

namespace risorius::tissue {

/// The list of contacts, their energy, and the shifts and gaps that are remembered from solve to solve.
class Contacts {
  public:
    static constexpr int kMostOthers = 6;
    struct Contact {
        int node = 0;                      ///< index of node a
        int others[kMostOthers] = {};      ///< indices of the nodes that carry the plane
        double weights[kMostOthers] = {};  ///< of the others, sum 1
        int count = 0;                     ///< number of other nodes, 0..kMostOthers
        Vec3 point = Vec3::Zero();         ///< p, m
        Vec3 normal = Vec3::UnitZ();       ///< n, length 1, towards node a
        double rest_gap_m = 0;             ///< g <= 0
        double stiffness_n_per_m = 0;      ///< kc, N/m
        int body = 0;                      ///< the body that p belongs to, numbered by the caller
        /// How well the plane represents the real surface, [0, 1]. It is a factor of the penetration in depth() only.
        double fraction = 1;
        int slot = -1;                     ///< number of the contact in memory; -1: it has none
        double stick_n = 0;                ///< Tmax; 0: no adhesion
        double stick_m = 0;                ///< dc, m
        double shift_m = 0;                ///< s >= 0, from memory
        double hardens_m = 0;              ///< h; 0: the law is linear
        std::optional<double> let_go_m{};  ///< remembered gap at which it was last pressed, m
    };

    /// Replaces the list. Contacts whose slot is in memory get their remembered shift and gap back.
    void set(std::vector<Contact> contacts);
    const std::vector<Contact>& list() const { return contacts_; }
    std::vector<Contact>& list() { return contacts_; }

    /// Updates the shifts and the adhesion. Call it after a solve that ended at `x`. The memory then contains only the slots of
    /// this list.
    void remember(const Points& x);
    void forget() { memory_.clear(); }
    /// What is remembered of a contact from solve to solve.
    struct Memory {
        int slot;
        double shift_m;
        std::optional<double> let_go_m;
    };
    const std::vector<Memory>& memory() const { return memory_; }
    /// Makes the next set() give back what was remembered then: a memory() of before.
    void recall(std::vector<Memory> memory) { memory_ = std::move(memory); }

    /// Replaces the list by contacts that harden with depth, without shifts and adhesion from memory. For solvers that use
    /// second derivatives. `hardens_m` is h.
    void set_firm(std::vector<Contact> contacts, double hardens_m);
    /// Updates the memory so that the contacts of the next set() press with the same force. Call it after a solve with
    /// set_firm().
    void remember_firm(const Points& x);

    static double gap(const Contact& contact, const Points& x);  ///< the gap at x, m
    /// dE/dgap, N. Negative values push the sides apart, positive values pull them together.
    static double pull_n(const Contact& contact, const Points& x);

    /// Returns E(x), J, and adds dE/dx to `gradient`, n x 3, N.
    double add_energy(const Points& x, Points& gradient) const;

    /// Penetration beyond that of the rest pose, times `fraction`, m; <= 0 without contact.
    static double depth(const Contact& contact, const Points& x) {
        return contact.fraction * (contact.rest_gap_m - gap(contact, x));
    }

    /// Adds the second derivative at x, N/m. That of adhesion is left out, so the result has no negative part. Open pairs are
    /// added too, so that the sparsity pattern does not depend on which contacts touch.
    void add_hessian(const Points& x, solve::HessianBuilder& hessian) const;

    /// Maximum depth() of all contacts, m; 0 without contact.
    double max_penetration(const Points& x) const;

  private:
    std::vector<Contact> contacts_;
    std::vector<Memory> memory_;  // ascending slots
};

/// Adds `stiffness_n_per_m` to the diagonal of every node that may ever touch something. The metric has no entries for pairs of
/// nodes: pairs change from step to step, but the metric must stay the same.
void add_metric_nodes(solve::MetricBuilder& builder, const std::vector<int>& nodes,
                      double stiffness_n_per_m);

}  // namespace risorius::tissue
