// The skin: a membrane of triangles with bending at the edges between them.
//
//   F   3 x 2 deformation gradient     A   rest area, m^2     k   membrane stiffness, N/m     kB
//   bending stiffness, N m membrane   A k/4 |F^T F - I|^2 bending    w/2 (s - S)^2,  s = |sum c_i
//   x_i|,  S = s at rest,  w = 3 kB / (A_1 + A_2),  c the cotangent stencil of the
//              four nodes of an edge (Bergou et al. 2006, "A quadratic bending model for
//              inextensible surfaces")
//
// The length s is rounded off near zero, s = sqrt(|l|^2 + (0.1 S)^2), so that its gradient exists
// everywhere; at a flat rest shape S = 0 and the term is the plain quadratic w/2 |l|^2.
#pragma once

#include <cstdint>
#include <vector>

#include "core/types.h"
#include "solve/lanes.h"
#include "solve/metric_builder.h"

namespace risorius::solve {
enum class Curvature;
class HessianBuilder;
}  // namespace risorius::solve

namespace risorius::tissue {

/// One object serves one thread at a time: it keeps scratch arrays.
class SkinSheet {
  public:
    /// Stiffnesses are one per triangle; a hinge takes the mean of its two. Edges with one
    /// triangle, or more than two, do not bend. Throws std::invalid_argument when a triangle has no
    /// area at rest.
    SkinSheet(const Triangles& triangles, const Points& rest,
              const Eigen::VectorXd& membrane_n_per_m, const Eigen::VectorXd& bending_n_m);

    /// Returns E(x), J, and adds dE/dx to `gradient`, n x 3, N. The terms are summed in a fixed
    /// order.
    double add_energy(const Points& x, Points& gradient) const;

    /// Adds the second derivative at x, all pairs of nodes always named in the same order; kPositive without its negative
    /// part, triangle by triangle and hinge by hinge.
    void add_hessian(const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const;

    /// sum 2 A k G G^T + w c c^T
    void add_metric(solve::MetricBuilder& builder) const;

    int triangle_count() const { return triangle_count_; }
    int hinge_count() const { return hinge_count_; }

  private:
    /// Four triangles, one per lane. The rest edges in the triangle's plane are (l, 0) and (ex,
    /// ey).
    struct alignas(64) TriangleGroup {
        solve::Lanes b00, b01, b11;  ///< their inverse, upper triangular
        solve::Lanes stiffness;      ///< A k
        std::int32_t node[3][4];     ///< [corner][lane]
    };
    /// Four hinges: the edge's ends, then the opposite corners.
    struct alignas(64) HingeGroup {
        solve::Lanes c[4];
        solve::Lanes w;
        solve::Lanes rest_length;       ///< S, rounded off like s
        solve::Lanes squared_rounding;  ///< (0.1 S)^2
        std::int32_t node[4][4];        ///< [corner][lane]
    };
    void add_hinges(const Triangles& triangles, const Points& rest,
                    const Eigen::VectorXd& bending_n_m);
    double membrane_energy() const;
    double bending_energy() const;

    int triangle_count_ = 0;
    int hinge_count_ = 0;
    std::vector<TriangleGroup> triangles_;
    std::vector<HingeGroup> hinges_;
    mutable solve::PaddedPoints x_, gradient_;
};

}  // namespace risorius::tissue
