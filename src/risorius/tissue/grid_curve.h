// SPDX-License-Identifier: MIT
/// \file
/// The deformable curve: M nodes over a in [0,1], any rest shape in space, five numbers in every node. It stretches and
/// bends; twist is not in the model.
///
///   r' = dr/da    G = r' . r'    s = |r'' - c r'|, its bent part; S at rest
///   energy  integral of 1/4 lambda (G - G0)^2 + 1/2 zeta (s - S)^2        dissipation  1/4 omega (dG/dt)^2
///
/// r'' counts without its part along r' that the rest shape has (unevenly spaced nodes), c r0'. Where the rest shape is
/// straight S = 0 and bending is the plain 1/2 zeta |r''|^2; elsewhere s is rounded off near zero,
/// s = sqrt(|..|^2 + (0.1 S)^2), as in SkinSheet, so that a curve bent straight has finite forces.
///
/// Source: Terzopoulos, Platt, Barr & Fleischer 1987, Elastically deformable models.
#pragma once

#include <string>
#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/detail/metric_elements.h"

namespace risorius::tissue {

struct CurveMaterial {
    double elastic_n_per_m3 = 0;   ///< lambda                                         [0, inf)
    double damping_ns_per_m3 = 0;  ///< omega                                          [0, inf)
    double bending_n_per_m = 0;    ///< zeta                                           [0, inf)
    double mass_kg = 1;            ///< of a whole curve of this; a node has 1/M of it (0, inf)
    double drag_ns_per_m = 0;      ///< c, of each node                                [0, inf)
};

struct GridCurve {
    Points rest;                          ///< M x 3, m; M >= 2
    std::vector<CurveMaterial> material;  ///< one, or one per node
    /// kResolutionIndependent: every value times 1/(M-1), the length of a link in a. That is eq. (10) with one axis, and
    /// for bending the trapezoidal rule with no moment at the ends.
    Parameters parameters = Parameters::kResolutionIndependent;
};

/// A straight rod of length L by its own constants: lambda = EA / (2 L^3), zeta = EI / L^3. Mass is left at its default.
CurveMaterial rod_material(double tension_stiffness_n, double bending_stiffness_n_m2,
                           double length_m);

/// From one point to another with even spacing.
Points line_rest(int nodes, const Vec3& from, const Vec3& to);

/// Throws Error with the field named below `place`: fewer than 2 nodes, NaN, negative values, no mass, neighbours in the
/// same place, a link turning back on the one before.
void check(const GridCurve& curve, const std::string& place);

Eigen::VectorXd node_mass(const GridCurve& curve);  ///< kg
Eigen::VectorXd node_drag(const GridCurve& curve);  ///< N s/m

/// Weight and drag are terms of their own.
class GridCurveTerm : public solve::EnergyTerm {
  public:
    /// `curve` has passed check().
    explicit GridCurveTerm(const GridCurve& curve);

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double bending_energy(const Points& x) const;  ///< J
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

  private:
    /// Second difference at an inner node.
    struct Bending {
        int node[3] = {};
        double d[3] = {};
        double zeta = 0;
        double rest = 0;              ///< S, rounded off like s
        double squared_rounding = 0;  ///< (0.1 S)^2
    };
    /// Calls visit(element, r'', s).
    template <class Visit>
    void for_each_bend(const Points& x, const Visit& visit) const;
    double add_bending_gradient(const Points& x, Points& gradient) const;

    MetricElements stretch_;
    std::vector<Bending> bending_;
};

}  // namespace risorius::tissue
