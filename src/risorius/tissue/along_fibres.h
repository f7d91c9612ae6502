// SPDX-License-Identifier: MIT
/// \file
/// What makes a solid stiffer along one direction than across it: the part of a transversely isotropic material that its isotropic
/// part lacks. The isotropic part is another term (cell_solid.h, tet_solid.h).
///
///   E = sum over points V [ s/2 ( |C a|^2 - (a . C a)^2 ) + k/2 max(l - 1, 0)^2 ],   C = F^T F,  l = sqrt(a . C a)
///
///   F   deformation gradient; a: direction at rest, a unit vector; l: stretch along it; V: rest volume, m^3
///   s   what the shear modulus along a has more than that across, mu_L - mu_T, Pa
///   k   what stretched fibres add to Young's modulus along a, Pa; shortened fibres go slack, as collagen does
///
/// With mu/4 |C - I|^2 + K/2 (J - 1)^2 and K >> mu, small strains have the moduli of an incompressible solid:
///   mu_T = mu,  mu_L = mu + s,  E_L = 3 mu + k in tension,  E_T = 3 mu in tension, where the fibres are shortened
/// Relaxed vastus lateralis has mu_L = 5.77, mu_T = 1.93 kPa and E_L / E_T - 1 = 4.67, which is k = 27 kPa. The pull grows with
/// the strain and not faster: what was measured are small strains.
///
/// Source of the numbers: PMC8754054 (shear waves in the muscle of one person).
#pragma once

#include <array>
#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/detail/cell_mesh.h"

namespace risorius::tissue {

/// A point of a solid at which strain is measured: F = sum over k < count of x[node[k]] gradient[k]^T.
struct StrainPoint {
    int count = 0;  ///< [1, 8]
    std::array<int, 8> node{};
    std::array<Vec3, 8> gradient{};  ///< 1/m
    double volume_m3 = 0;            ///< V
    Vec3 along = Vec3::UnitX();      ///< a
};

/// The middle of each cell, with fibres along the first axis of the mesh. `rest`: of its nodes, m. Throws
/// std::invalid_argument for a mesh with hanging vertices, and for a point without a positive volume.
std::vector<StrainPoint> strain_points(const CellMesh& mesh, const Points& rest);
/// One point per tetrahedron. `fibres`: T x 3, unit vectors.
std::vector<StrainPoint> strain_points(const Tets& tets, const Points& rest, const Points& fibres);

class AlongFibres final : public solve::EnergyTerm {
  public:
    struct Moduli {
        double shear_pa = 0;    ///< s, [0, inf)
        double stretch_pa = 0;  ///< k, [0, inf)
    };
    /// Throws std::invalid_argument for moduli outside their ranges.
    AlongFibres(std::vector<StrainPoint> points, const Moduli& moduli);

    const Moduli& moduli() const { return moduli_; }
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    /// The Cauchy stress at a deformation gradient, Pa: dW/dF F^T / J.
    static Mat3 cauchy_stress_pa(const Moduli& moduli, const Mat3& f, const Vec3& along);

  private:
    std::vector<StrainPoint> points_;
    Moduli moduli_;
};

}  // namespace risorius::tissue
