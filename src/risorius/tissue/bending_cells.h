// SPDX-License-Identifier: MIT
/// \file
/// A soft solid of trilinear cells that bends as a thin bar or plate does, with one cell across. CellSolid is too stiff there: a cell that is
/// bent shears, and its sides cannot curve.
///
///   E = sum over cells of V0 [ mu |E0|^2 + W' + K/2 (V / V0 - 1)^2 ]
///   E0   mean Green strain of the cell                          mu, K   as in cell_body.h; nu = K / (2 (K + mu))
///   W'   energy of the strain that varies in the cell, see below
///
/// The tangents of a cell vary with the material coordinates s1, s2, s3, -1..1, and so does the strain. Of what varies, these parts count:
///
///   s2        mu / (1 - nu) (E11^2 + E33^2 + 2 nu E11 E33) + 2 mu E13^2    the plane stress of a layer; s1 and s3 likewise
///   s2 s3     mu (1 + nu) E11^2                                            the stress of a fibre; the other pairs likewise
///
/// Shear between two axes is averaged over their plane (assumed natural strain), so it varies with the third axis only. Strain across a layer
/// is left to the law of plane stress, because a trilinear cell cannot show it. Cells must be boxes at rest.
///
/// Sources: Simo & Rifai 1990, Int. J. Numer. Methods Eng. 29, 1595-1638 (assumed strains); Dvorkin & Bathe 1984, Eng. Comput. 1, 77-88
/// (averaged shear); Nagtegaal, Parks & Rice 1974 (mean dilatation).
#pragma once

#include <array>
#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/cell_body.h"

namespace risorius::tissue {

class BendingCells : public solve::EnergyTerm {
  public:
    /// Throws std::invalid_argument unless the mesh is uniform, every cell is a box at rest, and the material is given by moduli without
    /// viscosity.
    explicit BendingCells(CellBody body);

    const CellBody& body() const { return body_; }
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

  private:
    static constexpr int kStrains = 18;
    using Strains = Eigen::Matrix<double, kStrains, 1>;
    using Modes = Eigen::Matrix<double, 7, 3>;

    struct Cell {
        std::array<int, 8> node;
        Vec3 edges;                  ///< at rest, m
        double mu, bulk;             ///< times the volume at rest
        double plane, cross, fibre;  ///< factors of mu: 1 / (1 - nu), nu / (1 - nu), 1 + nu
    };
    Modes modes_of(const Cell& cell, const Points& x) const;
    Strains strains_of(const Cell& cell, const Modes& modes) const;
    /// dE/dstrain
    Strains stress_of(const Cell& cell, const Strains& strain) const;

    CellBody body_;
    std::vector<Cell> cells_;
};

}  // namespace risorius::tissue
