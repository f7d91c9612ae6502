// SPDX-License-Identifier: MIT
/// \file
/// Resistance to a change of volume in a solid of tetrahedra, taken around nodes: linear tetrahedra of their own would be far too stiff where
/// the material hardly changes its volume. The resistance to a change of shape is another term (tet_solid.h).
///
///   E = sum over nodes K/2 V_a (J_a - 1)^2,   J_a = sum v_e / (4 V_a),   V_a = sum V_e / 4
///
///   v_e, V_e   volume of a tetrahedron, now and at rest, m^3; the sums are over the tetrahedra of node a
///   K          modulus of the volume term, Pa
///
/// Source: Bonet & Burton 1998, Commun. Numer. Methods Eng. 14, 437-449 (average nodal pressure).
#pragma once

#include <vector>

#include "risorius/solve/energy_term.h"

namespace risorius::tissue {

class NodeVolumes final : public solve::EnergyTerm {
  public:
    /// Throws std::invalid_argument for a modulus below 0 and for a tetrahedron without a positive volume.
    NodeVolumes(const Tets& tets, const Points& rest, double bulk_pa);

    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    /// kPositive: without what comes from the change of direction of the faces.
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    /// Mean of K (J_a - 1) over the corners of each tetrahedron, Pa: its part of the Cauchy stress, when J is near 1.
    Eigen::VectorXd pressures_pa(const Points& x) const;

  private:
    /// The tetrahedra of a node, and all their nodes.
    struct Patch {
        std::vector<int> tet;
        std::vector<int> node;
        double volume_m3 = 0;  ///< V_a
    };
    /// J_a of each patch.
    Eigen::VectorXd ratios(const Points& x) const;

    Tets tets_;
    Points rest_;
    double bulk_pa_;
    std::vector<Patch> patches_;
};

}  // namespace risorius::tissue
