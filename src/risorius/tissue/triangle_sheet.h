// SPDX-License-Identifier: MIT
/// \file
/// The deformable surface on any triangle mesh, with the same material as on a grid: metric, damping and bending tensors over
/// material coordinates a. Each triangle has its own a at its corners (texture coordinates, or metres along a fibre).
///
///   A    area of a triangle in a      r_i, G_ij   its tangents by a and their metric, constant over the triangle
///   b    curvature tensor of a triangle by a, from the folds theta of its edges      kappa = b as (b_11, b_22, sqrt2 b_12)
///
///   E = sum A (1/4 sum lambda_ij (G_ij - G0_ij)^2 + 1/2 sum zeta_ij (b_ij - b0_ij)^2)
///
/// Curvature follows from folds. On a smooth surface z = 1/2 x . b x the interpolating triangles fold by theta = B kappa, where
/// B is known from the rest shape; so b is solved from the folds theta - theta0. At a border some folds are missing. There b is
/// the tensor of minimum energy that agrees with the other folds, because no moment acts at a border.
///
/// Bending is then exact for constant curvature on any triangulation. A stiffness per hinge (SkinSheet) depends on the pattern
/// of triangles instead, by a factor of two in twist.
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
    /// kPositive: of stresses the positive part is used, and of bending the square of the first derivative.
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    /// A bound for a flat rest shape, and roughly right for a curved one.
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    /// K contains stresses and the bending of add_metric. The rest of the bending force is added to `force`.
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

    /// b - b0 of every triangle, (b_11, b_22, b_12) by a, m; zero where nothing bends.
    std::vector<Vec3> curvatures(const Points& x) const;

    int hinge_count() const { return static_cast<int>(hinges_.size()); }

  private:
    struct Hinge {
        int node[4] = {};  ///< nodes: ends of the edge, then opposite corners
        double rest = 0;   ///< theta0
        /// dtheta by the height of each corner above the flattened rest shape.
        double height[4] = {};
    };
    /// Bending of one triangle: 1/2 sum Q_ef (theta_e - theta0_e) (theta_f - theta0_f). Q contains the signs of the folds.
    struct Bend {
        int triangle = 0, count = 0;
        int hinge[3] = {};
        Mat3 Q = Mat3::Zero();
        Mat3 curvature = Mat3::Zero();  ///< (b_11, b_22, b_12) per unit of each fold
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
