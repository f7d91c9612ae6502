// SPDX-License-Identifier: MIT
/// \file
/// The deformable curve: M nodes over a in [0,1], any rest shape in space, and five material parameters for each node. It
/// stretches and bends; the model has no twist.
///
///   r' = dr/da    G = r' . r'    s = |r'' - e r'|, the bent part of r'';  S  s in the rest shape
///   energy  integral of 1/4 lambda (G - G0)^2 + 1/2 zeta (s - S)^2        dissipation  1/4 omega (dG/dt)^2
///
/// e r' is the part of r'' along r' in the rest shape. It is not zero where nodes are unevenly spaced. Where the rest shape is
/// straight, S = 0 and bending is the plain 1/2 zeta |r''|^2. Elsewhere s is rounded off near zero, s = sqrt(|..|^2 + (0.1
/// S)^2) as in SkinSheet, so that a curve that is bent straight has finite forces.
///
/// Source: Terzopoulos, Platt, Barr & Fleischer 1987, Elastically deformable models.
#pragma once

#include <string>
#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/detail/metric_elements.h"

namespace risorius::tissue {

/// The five parameters of a node.
struct CurveMaterial {
    double elastic_n_per_m3 = 0;   ///< lambda                                         [0, inf)
    double damping_ns_per_m3 = 0;  ///< omega                                          [0, inf)
    double bending_n_per_m = 0;    ///< zeta                                           [0, inf)
    double mass_kg = 1;  ///< of a whole curve of this material; a node has 1/M of it     (0, inf)
    double drag_ns_per_m = 0;  ///< c, of each node                                [0, inf)
};

/// The description of a curve.
struct GridCurve {
    Points rest;                          ///< M x 3, m; M >= 2
    std::vector<CurveMaterial> material;  ///< one, or one per node
    /// kResolutionIndependent: lambda, omega and zeta are multiplied by 1/(M-1), the length of a link in a. For lambda and
    /// omega this is eq. (10) of the thesis (solid_material.h) with one axis. For zeta it is the trapezoidal rule without
    /// moments at the ends.
    Parameters parameters = Parameters::kResolutionIndependent;
};

/// Material of a straight rod of length L: lambda = EA / (2 L^3), zeta = EI / L^3. EA is `tension_stiffness_n` and EI is
/// `bending_stiffness_n_m2`. The mass has its default value.
CurveMaterial rod_material(double tension_stiffness_n, double bending_stiffness_n_m2,
                           double length_m);

/// A straight line of evenly spaced nodes, M x 3, m.
Points line_rest(int nodes, const Vec3& from, const Vec3& to);

/// Throws Error for fewer than 2 nodes, NaN, negative values, no mass, neighbours at the same position, or a link that turns
/// back on the one before. The message names the field by its path, which begins with `place`.
void check(const GridCurve& curve, const std::string& place);

Eigen::VectorXd node_mass(const GridCurve& curve);  ///< of each node, kg
Eigen::VectorXd node_drag(const GridCurve& curve);  ///< c of each node, N s/m

/// Energy and forces of the curve. Weight and drag are terms of their own.
class GridCurveTerm : public solve::EnergyTerm {
  public:
    /// `curve` must have passed check().
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
    /// Second difference at an inner node: r'' - e r' = sum d_k x_k over the three nodes.
    struct Bending {
        int node[3] = {};
        double d[3] = {};
        double zeta = 0;
        double rest = 0;              ///< S, rounded off like s
        double squared_rounding = 0;  ///< (0.1 S)^2
    };
    /// Calls visit(element, r'' - e r', s) for every inner node.
    template <class Visit>
    void for_each_bend(const Points& x, const Visit& visit) const;
    double add_bending_gradient(const Points& x, Points& gradient) const;

    MetricElements stretch_;
    std::vector<Bending> bending_;
};

}  // namespace risorius::tissue
