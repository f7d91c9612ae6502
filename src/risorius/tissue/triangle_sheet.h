// SPDX-License-Identifier: MIT
/// \file
/// The deformable surface on any triangle mesh, with the same material as on a grid: metric, damping and bending tensors over
/// material coordinates a. Each triangle has material coordinates of its own at its corners: texture coordinates (no unit), or
/// metres along and across a fibre.
///
///   A    area of a triangle in a      r_i = dr/da_i, G_ij = r_i . r_j   its tangents and metric, constant over the triangle
///   b    curvature tensor of a triangle: second derivatives of its height by a, from the folds theta of its edges, rad;
///        in m, or in 1/m where a is in metres      kappa = b as the vector (b_11, b_22, sqrt2 b_12)
///
///   E = sum A (1/4 sum lambda_ij (G_ij - G0_ij)^2 + 1/2 sum zeta_ij (b_ij - b0_ij)^2)
///
/// The curvature is computed from folds. Triangles that interpolate a smooth surface z = 1/2 x . b x fold by theta = B kappa,
/// where the matrix B is known from the rest shape. So b - b0 is solved from the folds theta - theta0; the index 0 means the
/// rest shape. At a border some folds are missing. There b - b0 is the tensor of minimum energy that agrees with the other
/// folds, because no moment acts at a border.
///
/// Bending is then exact for constant curvature on any triangulation. A stiffness per hinge (SkinSheet) depends on the pattern
/// of triangles instead: in twist it varies by a factor of two.
#pragma once

#include <array>
#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/detail/metric_elements.h"
#include "risorius/tissue/triangle_surface.h"

namespace risorius::tissue {

/// Energy and forces of the surface. Weight is a term of its own.
class TriangleSheetTerm : public solve::EnergyTerm {
  public:
    /// `surface` must have passed check(). Edges that do not have exactly two triangles do not bend.
    explicit TriangleSheetTerm(const TriangleSurface& surface);

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double metric_energy(const Points& x) const { return metric_.energy(x); }  ///< J
    double bending_energy(const Points& x) const;                              ///< J
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    /// kPositive: for the metric term only the positive part of the stress is used. For bending the Gauss-Newton matrix is
    /// used, which has only products of first derivatives.
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    /// Adds a matrix that is a bound for a flat rest shape, and approximately right for a curved one.
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    /// K contains the metric term and the bending of add_metric(). The rest of the bending force is added to `force`, and so is
    /// the damping unless its rate is lagged.
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

    /// b - b0 of every triangle, (b_11, b_22, b_12), m, or 1/m where a is in metres; zero where nothing bends.
    std::vector<Vec3> curvatures(const Points& x) const;

    int hinge_count() const { return static_cast<int>(hinges_.size()); }

  private:
    struct Hinge {
        int node[4] = {};  ///< nodes: ends of the edge, then opposite corners
        double rest = 0;   ///< theta0
        /// Derivative of theta by the height of each corner above the flattened rest shape, rad/m.
        double height[4] = {};
    };
    /// Bending of one triangle: 1/2 sum Q_ef (theta_e - theta0_e) (theta_f - theta0_f). Q contains the signs of the folds.
    struct Bend {
        int triangle = 0, count = 0;
        int hinge[3] = {};
        Mat3 Q = Mat3::Zero();
        Mat3 curvature = Mat3::Zero();  ///< column k: (b_11, b_22, b_12) per rad of fold k
    };
    struct EdgeOf {
        int hinge = -1;  ///< -1: an edge of one triangle
        double sign = 1;
    };
    std::vector<std::array<EdgeOf, 3>> find_hinges(const TriangleSurface& surface);
    void add_bends(const TriangleSurface& surface);
    /// Computes theta - theta0 of every hinge and the moments sum Q (theta - theta0). Returns the energy.
    double fold(const Points& x, Eigen::VectorXd& moment) const;
    double add_bending_gradient(const Points& x, Points& gradient) const;
    /// Calls visit(nodes, coefficients, count, w) for the terms w c c^T of the bending metric.
    template <class Visit>
    void for_each_bending_mode(const Visit& visit) const;

    MetricElements metric_;
    std::vector<Hinge> hinges_;
    std::vector<Bend> bends_;
    int triangle_count_ = 0;
};

}  // namespace risorius::tissue
