// SPDX-License-Identifier: MIT
/// \file
/// The skin: a membrane of triangles that bends at the edges between them.
///
///     membrane   E = A k/4 |F^T F - I|^2
///     bending    E = w/2 (s - S)^2,   s = |sum c_i x_i|,   S = s in the rest shape,   w = 3 kB / (A_1 + A_2)
///
/// - F: 3 x 2 deformation gradient; G: gradients of the shape functions in a triangle, 1/m
/// - A: rest area, m^2
/// - k: membrane stiffness, N/m
/// - kB: bending stiffness, N m
/// - c: cotangent weights of the four nodes x_i of an edge (Bergou et al. 2006, "A quadratic bending model for
///   inextensible surfaces"); A_1, A_2: rest areas of its two triangles
///
/// The length s is rounded off near zero, s = sqrt(|l|^2 + (0.1 S)^2) with l = sum c_i x_i, so that its gradient exists
/// everywhere. For a flat rest shape S = 0, and the term is the plain quadratic w/2 |l|^2.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/lanes.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {
enum class Curvature;
class HessianBuilder;
}  // namespace risorius::solve

namespace risorius::tissue {

/// Energy and forces of the skin. An object keeps scratch arrays, so only one thread at a time may use it.
class SkinSheet {
  public:
    /// Stiffnesses are given per triangle; a hinge takes the mean of its two triangles. Edges that do not have exactly two
    /// triangles do not bend. Throws std::invalid_argument when a triangle has no rest area.
    SkinSheet(const Triangles& triangles, const Points& rest,
              const Eigen::VectorXd& membrane_n_per_m, const Eigen::VectorXd& bending_n_m);

    /// Returns E(x), J, and adds dE/dx to `gradient`, n x 3, N. The terms are summed in a fixed order. The energy is computed
    /// from displacements, so that the rest shape is exact in float too. In float, forces have a relative error of about 1e-6.
    double add_energy(const Points& x, Points& gradient,
                      solve::Precision precision = solve::Precision::kDouble) const;

    /// Adds the second derivative at x. All pairs of nodes are always added, in the same order. kPositive: the negative part of
    /// each triangle and each hinge is removed.
    void add_hessian(const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const;

    /// Adds the metric sum 2 A k G G^T + w c c^T, N/m.
    void add_metric(solve::MetricBuilder& builder) const;

    int triangle_count() const { return triangle_count_; }
    int hinge_count() const { return hinge_count_; }

  private:
    /// As many triangles as there are lanes. The two rest edges in the triangle's plane are (l, 0) and (ex, ey).
    template <class Real>
    struct alignas(64) TriangleGroup {
        using Lane = typename solve::LanesOf<Real>::Lane;
        static constexpr int kWidth = solve::LanesOf<Real>::kWidth;
        Lane b00, b01, b11;            ///< inverse of the matrix of rest edges, upper triangular
        Lane t[2][3];                  ///< axes of the plane
        Lane stiffness;                ///< A k
        std::int32_t node[3][kWidth];  ///< [corner][lane]
    };
    /// As many hinges as there are lanes. The nodes are the ends of the edge, then the opposite corners.
    template <class Real>
    struct alignas(64) HingeGroup {
        using Lane = typename solve::LanesOf<Real>::Lane;
        static constexpr int kWidth = solve::LanesOf<Real>::kWidth;
        Lane c[4];
        Lane rest[3];  ///< sum c_i X_i
        Lane w;
        Lane rest_length;              ///< S, rounded off like s
        Lane squared_rounding;         ///< (0.1 S)^2
        std::int32_t node[4][kWidth];  ///< [corner][lane]
    };
    template <class Real>
    struct Work {
        std::vector<TriangleGroup<Real>> triangles;
        std::vector<HingeGroup<Real>> hinges;
        solve::PaddedRows<Real> displacement, gradient;
    };
    struct Hinge {
        int node[4]{};
        double c[4]{};
        double w = 0, squared_rounding = 0;
        Vec3 rest = Vec3::Zero();
    };
    struct Triangle {
        int node[3];
        double b00, b01, b11, stiffness;
        Vec3 t[2];
    };
    template <class Group>
    int node_of(const Group& group, int corner, int lane) const {
        return rows_[static_cast<std::size_t>(group.node[corner][lane])];
    }
    std::vector<Hinge> hinges_of(const Triangles& triangles,
                                 const Eigen::VectorXd& bending_n_m) const;
    template <class Real>
    static void fill(const std::vector<Triangle>& triangles, const std::vector<Hinge>& hinges,
                     Work<Real>& work);
    template <class Real>
    double add_energy_in(Work<Real>& work, const Points& x, Points& gradient) const;
    template <class Real>
    static double membrane_energy(Work<Real>& work);
    template <class Real>
    static double bending_energy(Work<Real>& work);

    std::vector<int> rows_;  ///< nodes of the sheet; groups use indices into this list
    Points rest_;            ///< rest positions of the nodes in rows_
    int triangle_count_ = 0;
    int hinge_count_ = 0;
    mutable Work<double> double_;
    mutable Work<float> single_;
};

}  // namespace risorius::tissue
