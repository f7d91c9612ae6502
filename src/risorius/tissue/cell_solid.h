// SPDX-License-Identifier: MIT
/// \file
/// Volume-preserving soft solid of trilinear cells, on uniform and refined meshes. It has a metric term at 2 x 2 x 2 Gauss
/// points and one exact volume term per cell (mean dilatation).
///
///   E = sum over cells [ sum_8 (h1 h2 h3 / 8) 1/4 lambda_ij (G_ij - G0_ij)^2 + psi_c / (h1 h2 h3) (V_c - V_c0)^2 ]
///   G_ij = r_i . r_j,  r_i = dr/da_i,  V_c exact and signed,  0: in the rest shape
///
/// lambda_ij, omega_ij and psi_c are in cell_body.h; h1, h2, h3 are the edges of a cell in material coordinates. The damping is
/// the same metric sum with omega_ij and the strain rate dG/dt. In an implicit step of length h the rate is (G - G_n) / h,
/// where G_n is G at the start of the step. So rotation is not damped, and the damping potential depends on x alone.
///
/// With moduli in Pa the metric term is mu/4 |C dG|^2 sqrt(det G0) with dG = G - G0 and C = G0^-1 at every Gauss point; see
/// cell_body.h.
///
/// Sources: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005, sections 3.1-3.5 (the continuum); Nagtegaal, Parks & Rice
/// 1974 and Simo, Taylor & Pister 1985 (mean dilatation).
#pragma once

#include <memory>
#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/cell_body.h"

namespace risorius::tissue {

namespace detail {
class CellKernel;
struct CellMaterialLaw;
}  // namespace detail

/// Energy and forces of the solid. Weight and drag are terms of their own.
class CellSolid : public solve::EnergyTerm {
  public:
    /// Throws std::invalid_argument when a cell has no positive rest volume or when the arrays of `body` have wrong sizes.
    explicit CellSolid(CellBody body);
    ~CellSolid() override;

    const CellBody& body() const { return body_; }
    const CellMesh& mesh() const { return body_.mesh; }

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    /// K contains the metric term at x. The volume term is added to `force`, and so is the damping unless its rate is lagged.
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

    /// Positions of all vertices, hanging ones included, from the positions `x` of the nodes; V x 3, m.
    Points vertices(const Points& x) const;
    Eigen::VectorXd cell_volumes(const Points& x) const;       ///< of each cell, signed, m^3
    double volume(const Points& x) const;                      ///< of the body, m^3
    double rest_volume() const { return rest_volume_.sum(); }  ///< of the body, m^3
    int inverted_count(const Points& x) const;                 ///< number of cells with V_c <= 0

    /// Returns F at the centre of a cell.
    Mat3 deformation_gradient(const Points& vertices, int cell) const;
    /// Metric strain dG_ij = G_ij - G0_ij at the eight Gauss points of a cell, m^2. Point g is the one next to corner g.
    void metric_strain(const Points& vertices, int cell, Mat3 (&strain)[8]) const;
    /// C = G0^-1 at the centre of a cell, 1/m^2. C dG / 2 is the Green strain as a mixed tensor.
    Mat3 inverse_rest_metric(int cell) const;

  private:
    detail::CellMaterialLaw law(int cell) const;

    CellBody body_;
    Points rest_vertices_;
    Eigen::VectorXd rest_volume_;
    std::unique_ptr<detail::CellKernel> kernel_;
};

}  // namespace risorius::tissue
