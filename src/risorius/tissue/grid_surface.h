// SPDX-License-Identifier: MIT
/// \file
/// Energy and forces of a deformable surface, by finite differences over its grid as in the thesis. For a tube the differences
/// along a2 are periodic.
///
///   D_i r   forward difference along a_i, absent at the upper border         G_ij = D_i r . D_j r
///   D_11, D_22   central second difference, absent at borders     D_12   cross difference of a cell
///   t_k   tangent along a_k, by a difference centred at the same point as D_ij where nodes exist   n = t_1 x t_2 / |t_1 x t_2|
///
///   E = sum over nodes  1/4 sum eta_ij (G_ij - G0_ij)^2  +  1/2 sum zeta_ij |D_ij r - c^k t_k - c^n n|^2
///   R = sum over nodes  1/4 sum phi_ij (dG_ij/dt)^2
///
/// eta_ij, phi_ij and zeta_ij are the metric, damping and bending coefficients of a node (surface_material.h). r0 and the index
/// 0 mean the rest shape. c^k and c^n are the coordinates of D_ij r0 in the basis t_k, n of the rest shape. So bending compares
/// the second difference with that of the rest shape, which moves along with the surface. Every rest shape is free of force,
/// and rigid motion costs nothing. Where the rest shape is flat and evenly spaced, c = 0 and the plain 1/2 zeta |D_ij r|^2 is
/// left.
///
/// Other forms have defects. |D_ij r|^2 alone flattens a tube. |D_ij r - D_ij r0|^2 resists rotation. The form of Terzopoulos,
/// Platt, Barr & Fleischer 1987 is xi_ij (n . D_ij r - B0_ij)^2, with a stiffness xi_ij and the curvature tensor B0 of the rest
/// shape. It has no linear stiffness where B0 = 0.
///
/// Source: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005 ("the thesis").
#pragma once

#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/detail/metric_elements.h"
#include "risorius/tissue/surface_material.h"

namespace risorius::tissue {

/// Energy and forces of the surface. Weight and drag are terms of their own.
class GridSurfaceTerm : public solve::EnergyTerm {
  public:
    /// `surface` must have passed check().
    explicit GridSurfaceTerm(const GridSurface& surface);

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override {
        (void)t_s;
        return metric_.energy(x) + bending_energy(x);
    }
    double metric_energy(const Points& x) const { return metric_.energy(x); }  ///< J
    double bending_energy(const Points& x) const;                              ///< J
    /// The damping of a step of length h from x_n is h R = sum 1/4 phi_ij (G_ij - G_ij(x_n))^2 / h.
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    /// kPositive: for the metric term only the positive part of the stress is used. For bending the Gauss-Newton matrix is
    /// used, which has only products of first derivatives.
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    /// K contains the metric term and the bending of a flat rest shape. The part of bending that comes from a curved rest shape
    /// is added to `force`, and so is the damping unless its rate is lagged.
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

  private:
    /// One second difference. It has at most three nodes along one axis and two nodes beside them, or the four nodes of a cell.
    struct Bending {
        int count = 0;
        int node[5] = {};
        double second[5] = {};  ///< coefficients of D_ij r - c^k t_k
        double t[2][5] = {};    ///< coefficients of t_k
        double normal = 0;      ///< c^n; 0 where the rest shape is flat
        double zeta = 0;
    };

    void add_metric_elements(const GridSurface& surface);
    void add_bending_elements(const GridSurface& surface);
    void add_bending(const Points& rest, Bending element);
    double add_bending_gradient(const Points& x, Points& gradient) const;

    MetricElements metric_;
    std::vector<Bending> bending_;
    Points rest_;
};

}  // namespace risorius::tissue
