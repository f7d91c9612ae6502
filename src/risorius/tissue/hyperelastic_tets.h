// SPDX-License-Identifier: MIT
/// \file
/// A solid of tetrahedra with the materials of hyperelastic.h.
///
///   E = sum V W(F)
///   F   deformation gradient of a tetrahedron, constant in it;  V   its rest volume, m^3
///
/// Linear tetrahedra are too stiff where the material hardly changes its volume: use several across, and a bulk modulus of no more than
/// 100 shear moduli.
#pragma once

#include <vector>

#include "risorius/solve/energy_term.h"
#include "risorius/tissue/hyperelastic.h"

namespace risorius::tissue {

/// The description of the solid.
struct HyperelasticBody {
    Points rest;  ///< n x 3, m
    Tets tets;    ///< with positive volumes
    std::vector<Hyperelastic> materials;
    std::vector<int> material_of;  ///< of each tetrahedron
    Points fibres;  ///< T x 3, unit vectors; without rows when no material has fibres
};

class HyperelasticTets : public solve::EnergyTerm {
  public:
    /// Throws std::invalid_argument when the arrays do not fit together or a tetrahedron has no positive volume.
    explicit HyperelasticTets(HyperelasticBody body);

    const HyperelasticBody& body() const { return body_; }
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    Mat3 deformation_gradient(const Points& x, int tet) const;
    Mat3 cauchy_stress_pa(const Points& x, int tet) const;
    double volume(const Points& x) const;                                 ///< m^3
    const Eigen::VectorXd& rest_volumes() const { return rest_volume_; }  ///< m^3

  private:
    const Hyperelastic& material(int tet) const {
        return body_
            .materials[static_cast<std::size_t>(body_.material_of[static_cast<std::size_t>(tet)])];
    }
    Vec3 fibre(int tet) const {
        return body_.fibres.rows() > 0 ? Vec3(body_.fibres.row(tet).transpose()) : Vec3::UnitX();
    }
    /// Gradients of the shape functions of the four corners, 4 x 3, 1/m.
    Eigen::Matrix<double, 4, 3> gradients(int tet) const;

    HyperelasticBody body_;
    std::vector<Mat3> inverse_;  ///< of the matrix of rest edges
    Eigen::VectorXd rest_volume_;
};

}  // namespace risorius::tissue
