// SPDX-License-Identifier: MIT
/// \file
/// The grid solid in the finite differences of the thesis (discretisation A): forward differences of positions and backward
/// differences of stress. Differences across the border are zero.
///
///   r_i    = (r[n + u_i] - r[n]) / h_i, zero where n + u_i is outside      G_ij = r_i . r_j
///   E      = sum over nodes of [ 1/4 sum_ij eta_ij (G_ij - G0_ij)^2 + psi (dV - dV0)^2 ],  dV = r_1 . (r_2 x r_3), signed
///   force  = - dE/dr, with the stress s_ij = eta_ij (G_ij - G0_ij) + phi_ij (v_i . r_j + r_i . v_j) in the metric term
///
/// r[n] is the position of node n. u_i is the step to the next node along a_i, h_i is the spacing of nodes in a_i, and v_i is
/// the same difference of the velocities as r_i. The index 0 means the rest shape. eta, phi and psi are coefficients of each
/// node. The sums over nodes have no other factors, and psi is not scaled with the resolution. A node without all three forward
/// neighbours has no volume term. Without damping, the force is the exact negative gradient of the energy.
///
/// Because the differences are one-sided, a hanging cube moves sideways by some thousandths of its length, and the result
/// depends on which end is held. CellSolid has neither defect.
///
/// In an implicit step of length h from x_n, the damping force is the negative gradient of sum 1/4 phi_ij (G_ij - G_ij(x_n))^2
/// / h.
///
/// Sources: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005 ("the thesis"), eq. (3), (6), (8), (10); Terzopoulos,
/// Platt, Barr & Fleischer 1987 for the differences at borders.
#pragma once

#include <string>
#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/solve/lanes.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

/// Energy and forces of the solid. Weight and drag are terms of their own.
class DifferenceSolid : public solve::EnergyTerm {
  public:
    /// The nodes of the system must be those of the grid. Throws the Error of check(solid, place). Mass and drag are not part
    /// of this term: see node_mass and node_drag.
    explicit DifferenceSolid(const GridSolid& solid, const std::string& place = "solid");

    const GridShape& grid() const { return grid_; }
    const Points& rest() const { return rest_; }

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    /// kPositive: only the positive part of each node's stress is used, and the second derivative of dV is left out.
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    /// The matrix of each node is a fixed pattern times a factor: the smallest one that bounds the second derivative of the
    /// node's energy at the rest shape.
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    /// The volume force is added to `force`, and so is the damping unless its rate is lagged.
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

    /// Sum of dV over nodes, m^3, as plotted in figure 9a of the thesis. Only its change from rest has a meaning.
    double volume_element_sum(const Points& x) const;
    int inverted_count(const Points& x) const;  ///< number of nodes with dV <= 0

  private:
    using Lanes = solve::Lanes;

    /// Coefficients of four nodes that are consecutive in memory. Pairs ij are in the order 11, 22, 33, 12, 23, 31. Where a
    /// forward neighbour is missing, 1/h is zero; so the tangent is zero too, and every node uses the same arithmetic.
    struct alignas(32) Group {
        Lanes inverse_h[3];
        Lanes eta[6], phi[6];
        Lanes g0[6];
        Lanes psi, dv0;
    };
    struct Tangents;
    struct Stress;

    /// Which parts of the force are wanted.
    struct Parts {
        bool elastic, damping, volume;
    };

    void load(const Points& x, std::vector<double>& lanes) const;
    Tangents tangents(const std::vector<double>& x, int group) const;
    void store(int group, const Tangents& tangents, const Stress& stress) const;
    void add_differences(double sign, Points& sum) const;
    void add_force_parts(const Parts& parts, const Points& x, const Points& v, Points& force) const;

    /// One node in matrix form, for everything outside the innermost loop.
    struct Node {
        int nodes[4];  ///< the node and its forward neighbours; the node again where one is missing
        Vec3 inverse_h;  ///< zero where a neighbour is missing
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
    int stride_;                         ///< distance from the x to the y and z arrays in x_ and v_
    int q_stride_;                       ///< distance between the components of q_
    mutable std::vector<double> x_, v_;  ///< x, y, z as contiguous arrays, followed by zeros
    /// dE/d(r_i) / h_i of all nodes, with damping (the sum of s_ij r_j over j plus the volume part), component by component,
    /// with zeros before and behind.
    mutable std::vector<double> q_;
};

}  // namespace risorius::tissue
