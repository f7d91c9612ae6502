// SPDX-License-Identifier: MIT
/// \file
/// The grid solid in the thesis' finite differences (discretisation A): forward differences of positions, backward
/// differences of stress, nothing beyond the border.
///
///   r_i    = (r[n + u_i] - r[n]) / h_i, zero where n + u_i is outside      G_ij = r_i . r_j
///   E      = sum over nodes of [ 1/4 sum_ij eta_ij (G_ij - G0_ij)^2 + psi (dV - dV0)^2 ],  dV = r_1 . (r_2 x r_3), signed
///   force  = - dE/dr - damping: s_ij = eta_ij (G_ij - G0_ij) + phi_ij (v_i . r_j + r_i . v_j) in place of alpha_ij
///
/// eta, phi and psi are coefficients of each node: sums over nodes carry no further weight, and psi is not scaled with the
/// resolution. A node without all three forward neighbours has no volume term. The force is the exact slope of the energy.
/// Because the differences look to one side, a hanging cube drifts sideways by some per mille of its length and its
/// result depends on which end is held; CellSolid has neither defect.
///
/// In implicit steps the damping is that of the potential sum 1/4 phi_ij (G_ij - G_ij(x_n))^2 / h.
///
/// Source: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005, eq. (3), (6), (8), (10); Terzopoulos, Platt, Barr &
/// Fleischer 1987 for the differences at borders.
#pragma once

#include <string>
#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/solve/lanes.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

class DifferenceSolid : public solve::EnergyTerm {
  public:
    /// Nodes of the system are those of the grid. Throws Error as check(solid, place) does. Mass and drag are not its
    /// affair: see node_mass and node_drag.
    explicit DifferenceSolid(const GridSolid& solid, const std::string& place = "solid");

    const GridShape& grid() const { return grid_; }
    const Points& rest() const { return rest_; }

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    /// kPositive keeps the positive part of each node's stress and leaves out the curvature of dV.
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    /// The least multiple of a fixed pattern per node that bounds the node's second derivative at rest.
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    /// The volume force, and the damping unless it is lagged, are added to `force`.
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

    /// Sum over nodes of dV, m^3, what the thesis plots in figure 9a: only its change relative to rest has a meaning.
    double volume_element_sum(const Points& x) const;
    int inverted_count(const Points& x) const;  ///< nodes with dV <= 0 among those that have dV

  private:
    using Lanes = solve::Lanes;

    /// Coefficients of four nodes that follow each other in memory. Pairs ij in the order 11, 22, 33, 12, 23, 31. Where a
    /// forward neighbour is missing 1/h is zero, so that the tangent is, and the same arithmetic serves every node.
    struct alignas(32) Group {
        Lanes inverse_h[3];
        Lanes eta[6], phi[6];
        Lanes g0[6];
        Lanes psi, dv0;
    };
    struct Tangents;
    struct Stress;

    /// What of the force is wanted.
    struct Parts {
        bool elastic, damping, volume;
    };

    void load(const Points& x, std::vector<double>& lanes) const;
    Tangents tangents(const std::vector<double>& x, int group) const;
    void store(int group, const Tangents& tangents, const Stress& stress) const;
    void add_differences(double sign, Points& sum) const;
    void add_force_parts(const Parts& parts, const Points& x, const Points& v, Points& force) const;

    /// The same for one node, in matrices, for what is not called in the innermost loop.
    struct Node {
        int nodes[4];    ///< itself and the forward neighbours, itself again where there is none
        Vec3 inverse_h;  ///< zero where there is none
        Mat3 eta, phi;
        double psi = 0, dv0 = 0;
        Mat3 g0;
        Mat3 tangents(const Points& x) const;  ///< columns r_i
    };
    Node node_at(int node) const;

    GridShape grid_;
    Points rest_;
    bool damped_ = false, incompressible_ = false;
    std::vector<Group> groups_;
    int ahead_[3];                       ///< rows from a node to its forward neighbours
    int stride_;                         ///< between the coordinates in x_ and v_
    int q_stride_;                       ///< between the components of q_
    mutable std::vector<double> x_, v_;  ///< x, y, z each in one piece, zeros behind
    mutable std::vector<double> q_;  ///< P_i / h_i, component by component, zeros before and behind
};

}  // namespace risorius::tissue
