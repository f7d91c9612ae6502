// SPDX-License-Identifier: MIT
/// \file
/// Passive fibres in tetrahedra: collagen that resists stretch along one direction and nothing else. With an isotropic solid of the
/// same tetrahedra they make it transversely isotropic.
///
///   E = sum V W(u),   u = |F a|^2 - 1
///   W = 0 where u <= 0;   k1 / (2 k2) (exp(k2 u^2) - 1) above      (k2 = 0: k1 u^2 / 2)
///
/// F is the deformation gradient of a tetrahedron, a the unit direction of its fibres at rest, and V its rest volume, m^3. Along the
/// fibres the modulus at rest is 4 k1. Where k2 u^2 exceeds 6, dW/du goes on as a straight line, so that no stretch overflows. W is
/// finite for inverted tetrahedra, too.
///
/// Source: Holzapfel, Gasser & Ogden 2000, J. Elasticity 61, 1-48, with |F a| for the isochoric stretch, from which it differs by the
/// change of volume.
#pragma once

#include <vector>

#include "risorius/solve/energy_term.h"

namespace risorius::tissue {

struct CollagenFibres {
    int nodes[4] = {0, 0, 0, 0};  ///< of the tetrahedron
    int tet = 0;                  ///< its number, for the caller
    Vec3 along = Vec3::UnitX();   ///< a, a unit vector
    double k1_pa = 0;             ///< (0, inf)
    double k2 = 0;                ///< [0, inf)
};

class CollagenTets : public solve::EnergyTerm {
  public:
    /// `rest`: n x 3, m. A tetrahedron may have several families of fibres. Throws std::invalid_argument if one has no positive
    /// volume.
    CollagenTets(std::vector<CollagenFibres> fibres, const Points& rest);

    const std::vector<CollagenFibres>& list() const { return fibres_; }
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    double stretch(const Points& x, std::size_t i) const;         ///< |F a|
    Mat3 cauchy_stress_pa(const Points& x, std::size_t i) const;  ///< of these fibres alone

  private:
    /// F a, from the rates at which the corners move the fibre.
    Vec3 moved(const Points& x, std::size_t i) const;

    std::vector<CollagenFibres> fibres_;
    std::vector<Eigen::Vector4d> rate_;  // gradients of the shape functions along a, 1/m
    std::vector<Mat3> inverse_;          // of the matrix of rest edges
    std::vector<double> volume_m3_;
};

}  // namespace risorius::tissue
