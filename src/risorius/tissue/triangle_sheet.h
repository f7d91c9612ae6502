// SPDX-License-Identifier: MIT
/// \file
/// The deformable surface on any triangle mesh, from the same material as on a grid: metric, damping and bending tensors
/// over material coordinates a that each triangle's corners are given (texture coordinates, or metres along a fibre).
///
///   A    area of a triangle in a      r_i, G_ij   its tangents by a and their metric, constant over the triangle
///   b    curvature tensor of a triangle by a, from the folds theta of its edges      kappa = b with (b_11, b_22, sqrt2 b_12)
///
///   E = sum A (1/4 sum lambda_ij (G_ij - G0_ij)^2 + 1/2 sum zeta_ij (b_ij - b0_ij)^2)
///
/// Curvature from folds: on a smooth surface z = 1/2 x . b x the interpolating triangles fold by theta = B kappa, B known
/// from the rest shape; so b is what the folds theta - theta0 mean, and at a border, where folds are missing, the b of
/// least energy among those that agree with the others (no moment acts there). Bending is then exact for constant curvature
/// on any triangulation, where a stiffness per hinge (SkinSheet) depends on how the triangles lie, by a factor of two in
/// twist.
#pragma once

#include <array>
#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/detail/metric_elements.h"
#include "risorius/tissue/triangle_surface.h"

namespace risorius::tissue {

class TriangleSheetTerm : public solve::EnergyTerm {
  public:
    /// `surface` has passed check(). Edges of one triangle, or more than two, do not bend.
    explicit TriangleSheetTerm(const TriangleSurface& surface);

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double metric_energy(const Points& x) const { return metric_.energy(x); }  ///< J
    double bending_energy(const Points& x) const;                              ///< J
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    /// kPositive: stresses keep their positive part, and bending the square of its first derivative.
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    /// A bound for a flat rest shape; of curved ones it is about right.
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    /// K has stresses and add_metric's bending; `force` has what the folds differ by from that.
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

    /// b - b0 of every triangle, (b_11, b_22, b_12) by a, m; zero where nothing bends.
    std::vector<Vec3> curvatures(const Points& x) const;

    int hinge_count() const { return static_cast<int>(hinges_.size()); }

  private:
    struct Hinge {
        int node[4] = {};  ///< ends of the edge, opposite corners
        double rest = 0;   ///< theta0
        double height[4] =
            {};  ///< dtheta by the height of each corner over the flattened rest shape
    };
    /// Bending of one triangle: 1/2 sum Q_ef (theta_e - theta0_e) (theta_f - theta0_f), signs of the folds within Q.
    struct Bend {
        int triangle = 0, count = 0;
        int hinge[3] = {};
        Mat3 Q = Mat3::Zero();
        Mat3 curvature = Mat3::Zero();  ///< (b_11, b_22, b_12) by each fold
    };
    struct EdgeOf {
        int hinge = -1;  ///< -1: an edge of one triangle
        double sign = 1;
    };
    std::vector<std::array<EdgeOf, 3>> find_hinges(const TriangleSurface& surface);
    void add_bends(const TriangleSurface& surface);
    /// theta - theta0 of every hinge, and the moments sum Q (theta - theta0); returns the energy.
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
