// Penalty contact between single nodes and planes, with the pairs and normals frozen by the caller
// for the length of a solve: searching them anew inside the energy breaks its line search.
//
//   gap = (x_a - sum w_i x_i - p) . n        E = kc/2 min(0, gap - g)^2
//
// The plane is carried by up to four other nodes with weights w (p is then the constant offset from
// them, usually zero), or by none and p is a point of it. g is the rest gap min(0, gap at rest), so
// that rest is free of force.
#pragma once

#include <vector>

#include "core/types.h"
#include "solve/metric_builder.h"

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
        int body = 0;                      ///< what p rides on, as the caller counts bodies
    };

    void set(std::vector<Contact> contacts);
    const std::vector<Contact>& list() const { return contacts_; }
    std::vector<Contact>& list() { return contacts_; }

    static double gap(const Contact& contact, const Points& x);  ///< m

    /// Returns E(x), J, and adds dE/dx to `gradient`, n x 3, N.
    double add_energy(const Points& x, Points& gradient) const;

    /// Adds the second derivative at x, which has no negative part; pairs apart are named too, so that the pattern does not
    /// hang on what touches.
    void add_hessian(const Points& x, solve::HessianBuilder& hessian) const;

    /// The deepest penetration beyond the one at rest, m; 0 when nothing touches.
    double max_penetration(const Points& x) const;

  private:
    std::vector<Contact> contacts_;
};

/// Pairs change from step to step but the metric must not: every node that may ever touch gets
/// `stiffness` on its diagonal.
void add_metric_nodes(solve::MetricBuilder& builder, const std::vector<int>& nodes,
                      double stiffness_n_per_m);

}  // namespace risorius::tissue
