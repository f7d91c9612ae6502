// SPDX-License-Identifier: MIT
/// \file
/// Converts the parameters of a grid solid to elastic moduli and back.
///
///   mu    shear modulus, Pa          K     modulus of the volume term, Pa (Lame's first parameter, not the bulk modulus)
///   E     Young's modulus, Pa        nu    Poisson's ratio            B = K + 2 mu / 3   bulk modulus, Pa
///   L_i   rest edge lengths, m       V0 = L_1 L_2 L_3
///
/// A block with lambda_ij = mu V0 / (L_i^2 L_j^2) and psi = K / (2 V0) has the following energy per rest volume, where F is the
/// deformation gradient, J = det F, eps is the small strain, and sigma is the stress, Pa:
///
///   mu/4 |F^T F - I|^2 + K/2 (J - 1)^2;  for small strains  sigma = 2 mu eps + K tr(eps) I,  nu = K / (2 (K + mu))
///
/// So the metric term alone (K = 0) has E = 2 mu and nu = 0. omega_ij is computed from a shear viscosity, Pa s, as lambda_ij is
/// from mu. For a rest shape that is not a block, the relation holds in each cell, with the lengths of the tangents r_i of the
/// cell.
#pragma once

#include "risorius/core/types.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

/// Moduli of the energy above, Pa.
struct IsotropicModuli {
    double shear_pa = 0;   ///< mu     (0, inf)
    double volume_pa = 0;  ///< K      [0, inf)
};

double youngs_modulus(const IsotropicModuli& moduli);  ///< E, Pa
double poisson_ratio(const IsotropicModuli& moduli);   ///< nu, in [0, 0.5)
double bulk_modulus(const IsotropicModuli& moduli);    ///< B, Pa

/// Throws std::invalid_argument unless E > 0 and 0 <= nu < 0.5. A negative ratio would need psi < 0.
IsotropicModuli moduli_of_young(double youngs_modulus_pa, double poisson_ratio);
/// Throws std::invalid_argument unless mu > 0 and B >= 2 mu / 3.
IsotropicModuli moduli_of_bulk(double shear_modulus_pa, double bulk_modulus_pa);

/// lambda, N/m^3, of an isotropic block with edges L, from mu, Pa. Or omega, N s/m^3, from a viscosity, Pa s.
Mat3 block_tensor(double modulus, const Vec3& edges_m);
/// The inverse of block_tensor, entry by entry, Pa: 2 entry(i, i) is the Young's modulus along a_i without the volume term,
/// entry(i, j) is the shear modulus between a_i and a_j. All entries are mu for block_tensor(mu).
Mat3 block_moduli(const Mat3& tensor, const Vec3& edges_m);

/// psi of the continuum, N/m^5, from K, Pa; and K from psi. Solids of cells use this psi.
double incompressibility(double volume_modulus_pa, double rest_volume_m3);
double volume_modulus(double incompressibility_n_per_m5, double rest_volume_m3);

/// psi of a node, N/m^5, from K, Pa; and K from psi. DifferenceSolid uses this psi. When psi of a node is constant, K grows
/// with the number of cells.
double nodal_incompressibility(double volume_modulus_pa, double rest_volume_m3,
                               const GridShape& grid);
double nodal_volume_modulus(double incompressibility_n_per_m5, double rest_volume_m3,
                            const GridShape& grid);

/// The shear modulus between a_i and a_j that a DifferenceSolid has, as a fraction of mu, when its parameters come from eq.
/// (10) of the thesis (solid_material.h). Only nodes with both forward neighbours resist shear, but eq. (10) counts all nodes.
/// It is 2/3 at 3^3 and 8/9 at 9^3.
double nodal_shear_fraction(const GridShape& grid, int i, int j);

}  // namespace risorius::tissue
