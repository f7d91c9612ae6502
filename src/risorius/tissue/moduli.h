// SPDX-License-Identifier: MIT
/// \file
/// What the parameters of a grid solid are in the terms of elasticity: plain functions both ways.
///
///   mu    shear modulus, Pa          K     modulus of the volume term, Pa (Lame's first parameter, not the bulk modulus)
///   E     Young's modulus, Pa        nu    Poisson's ratio            B = K + 2 mu / 3   bulk modulus, Pa
///   L_i   rest edge lengths, m       V0 = L_1 L_2 L_3
///
/// A block with lambda_ij = mu V0 / (L_i^2 L_j^2) and psi = K / (2 V0) stores, per rest volume,
///
///   mu/4 |F^T F - I|^2 + K/2 (J - 1)^2:  small strains meet  sigma = 2 mu eps + K tr(eps) I,  nu = K / (2 (K + mu))
///
/// so the metric term alone (K = 0) has E = 2 mu, nu = 0. omega_ij relates to a shear viscosity, Pa s, as lambda_ij does to mu.
/// For a rest shape that is no block the relation holds cell by cell with the lengths of the cell's tangents r_i.
#pragma once

#include "risorius/core/types.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

struct IsotropicModuli {
    double shear_pa = 0;   ///< mu     (0, inf)
    double volume_pa = 0;  ///< K      [0, inf)
};

double youngs_modulus(const IsotropicModuli& moduli);  ///< E, Pa
double poisson_ratio(const IsotropicModuli& moduli);   ///< nu, in [0, 0.5)
double bulk_modulus(const IsotropicModuli& moduli);    ///< B, Pa

/// Throws std::invalid_argument unless E > 0 and 0 <= nu < 0.5: psi >= 0 cannot make a negative ratio.
IsotropicModuli moduli_of_young(double youngs_modulus_pa, double poisson_ratio);
/// Throws std::invalid_argument unless mu > 0 and B >= 2 mu / 3.
IsotropicModuli moduli_of_bulk(double shear_modulus_pa, double bulk_modulus_pa);

/// lambda (or omega) of an isotropic block with edges L, from mu (or a viscosity).
Mat3 block_tensor(double modulus, const Vec3& edges_m);
/// Back, direction by direction: 2 entry(i, i) is the Young's modulus along a_i without the volume term, entry(i, j) the shear
/// modulus between a_i and a_j; all are mu when the tensor is block_tensor(mu).
Mat3 block_moduli(const Mat3& tensor, const Vec3& edges_m);

/// psi of the continuum, what cells take.
double incompressibility(double volume_modulus_pa, double rest_volume_m3);
double volume_modulus(double incompressibility_n_per_m5, double rest_volume_m3);

/// psi of a node, what finite differences take: there K grows with the number of cells when psi stays.
double nodal_incompressibility(double volume_modulus_pa, double rest_volume_m3,
                               const GridShape& grid);
double nodal_volume_modulus(double incompressibility_n_per_m5, double rest_volume_m3,
                            const GridShape& grid);

/// The share of mu that finite differences with eq. (10) set against shear between a_i and a_j: only nodes with both forward
/// neighbours feel it, and eq. (10) counts them as if all did. 2/3 at 3^3, 8/9 at 9^3.
double nodal_shear_fraction(const GridShape& grid, int i, int j);

}  // namespace risorius::tissue
