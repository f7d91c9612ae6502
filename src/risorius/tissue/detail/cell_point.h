// SPDX-License-Identifier: MIT
/// \file
/// Stiffness, secant matrix, metric and strain of one cell from its Gauss points, in scalar arithmetic. These are not inner
/// loops.
///
///   s_ij  stress over material coordinates: dE/dr_i = sum_j s_ij r_j at a Gauss point, times its weight
#pragma once

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/cell_body.h"

namespace risorius::tissue::detail {

using CellStiffness = Eigen::Matrix<double, 24, 24, Eigen::RowMajor>;
using CellScalarMatrix = Eigen::Matrix<double, 8, 8, Eigen::RowMajor>;

/// Positions of the eight corners of a cell, m.
struct CellCorners {
    Eigen::Matrix<double, 3, 8> x;  ///< a column per corner

    CellCorners() { x.setZero(); }
    CellCorners(const CellMesh::Cell& cell, const Points& vertices) {
        for (int c = 0; c < 8; ++c)
            x.col(c) = vertices.row(cell.vertex[static_cast<std::size_t>(c)]).transpose();
    }
};

/// The law of one cell: the parameters of the thesis (cell_body.h) or moduli.
struct CellMaterialLaw {
    explicit CellMaterialLaw(const CellParameters& p) : parameters(p) {}
    explicit CellMaterialLaw(const CellModuli& m) : physical(true), moduli(m) {}

    bool physical = false;
    CellParameters parameters;
    CellModuli moduli;
};

/// The start of an implicit step. The strain rate is rate_hz times the change of strain since then.
struct RateReference {
    double rate_hz = 0;
    CellCorners start;
};

/// Derivatives of the eight shape functions by a at Gauss point g, the one next to corner g; 3 x 8.
Eigen::Matrix<double, 3, 8> shape_derivatives(const Vec3& size, int g);
Mat3 tangents_at(const CellCorners& corners, const Vec3& size, int g);  ///< [r_1 r_2 r_3]
Mat3 metric_at(const CellCorners& corners, const Vec3& size, int g);    ///< G

/// psi_c / (h1 h2 h3), for either law.
double volume_stiffness(const CellMaterialLaw& law, const Vec3& size, double rest_volume);

/// Second derivative of the cell's energy, and of h R when `rate` is given; 24 x 24, N/m.
void cell_stiffness(const CellMaterialLaw& law, const Vec3& size, const CellCorners& rest,
                    const CellCorners& now, const RateReference* rate, solve::Curvature curvature,
                    CellStiffness& stiffness);

/// Bound of the stiffness at the rest shape, N/m: an 8 x 8 matrix with one number per pair of corners, used for x, y and z
/// alike.
CellScalarMatrix cell_metric(const CellMaterialLaw& law, const Vec3& size, const CellCorners& rest,
                             double rate_hz);

/// The force on the corners of a cell, - matrix x + force, N. `matrix` is the metric term. `force` is the volume term, and the
/// damping unless its rate is lagged; then `matrix` contains the damping.
struct CellSecant {
    CellScalarMatrix matrix;
    Eigen::Matrix<double, 8, 3> force;
};
CellSecant cell_secant(const CellMaterialLaw& law, const Vec3& size, const CellCorners& rest,
                       const CellCorners& now, const CellCorners& speed, bool lag_rate);

}  // namespace risorius::tissue::detail
