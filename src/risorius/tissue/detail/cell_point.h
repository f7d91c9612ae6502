// SPDX-License-Identifier: MIT
/// \file
/// One cell at its Gauss points, in scalar arithmetic: stiffness, secant, metric and strain, which are not inner loops.
///
///   s_ij  stress on material coordinates: dE/dr_i = sum_j s_ij r_j at a Gauss point, times its weight
#pragma once

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/cell_body.h"

namespace risorius::tissue::detail {

using CellStiffness = Eigen::Matrix<double, 24, 24, Eigen::RowMajor>;
using CellScalarMatrix = Eigen::Matrix<double, 8, 8, Eigen::RowMajor>;

struct CellCorners {
    Eigen::Matrix<double, 3, 8> x;  ///< a column per corner

    CellCorners() { x.setZero(); }
    CellCorners(const CellMesh::Cell& cell, const Points& vertices) {
        for (int c = 0; c < 8; ++c)
            x.col(c) = vertices.row(cell.vertex[static_cast<std::size_t>(c)]).transpose();
    }
};

/// The law of one cell: the thesis' parameters or moduli.
struct CellMaterialLaw {
    explicit CellMaterialLaw(const CellParameters& p) : parameters(p) {}
    explicit CellMaterialLaw(const CellModuli& m) : physical(true), moduli(m) {}

    bool physical = false;
    CellParameters parameters;
    CellModuli moduli;
};

/// Start of an implicit step. Strain rates are differences from it.
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

/// Second derivative of the cell's energy, and of h R when `rate` is given; 24 x 24.
void cell_stiffness(const CellMaterialLaw& law, const Vec3& size, const CellCorners& rest,
                    const CellCorners& now, const RateReference* rate, solve::Curvature curvature,
                    CellStiffness& stiffness);

/// Bound of the stiffness at the rest shape, as one scalar matrix that serves x, y and z.
CellScalarMatrix cell_metric(const CellMaterialLaw& law, const Vec3& size, const CellCorners& rest,
                             double rate_hz);

/// The metric term as a force -matrix x. The volume term, and damping unless its rate is lagged, as a force.
struct CellSecant {
    CellScalarMatrix matrix;
    Eigen::Matrix<double, 8, 3> force;
};
CellSecant cell_secant(const CellMaterialLaw& law, const Vec3& size, const CellCorners& rest,
                       const CellCorners& now, const CellCorners& speed, bool lag_rate);

}  // namespace risorius::tissue::detail
