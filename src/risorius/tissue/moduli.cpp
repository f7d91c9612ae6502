// SPDX-License-Identifier: MIT
#include "risorius/tissue/moduli.h"

#include <stdexcept>

namespace risorius::tissue {

namespace {

double cells(const GridShape& grid) { return (grid.m - 1.0) * (grid.n - 1.0) * (grid.o - 1.0); }

/// V0 / (L_i^2 L_j^2), 1/m
Mat3 block_scale(const Vec3& edges) {
    const Vec3 squares = edges.cwiseProduct(edges);
    return edges.prod() * (squares * squares.transpose()).cwiseInverse();
}

}  // namespace

double youngs_modulus(const IsotropicModuli& moduli) {
    const double mu = moduli.shear_pa, k = moduli.volume_pa;
    return mu * (3 * k + 2 * mu) / (k + mu);
}

double poisson_ratio(const IsotropicModuli& moduli) {
    return 0.5 * moduli.volume_pa / (moduli.volume_pa + moduli.shear_pa);
}

double bulk_modulus(const IsotropicModuli& moduli) {
    return moduli.volume_pa + 2.0 / 3.0 * moduli.shear_pa;
}

IsotropicModuli moduli_of_young(double e, double nu) {
    if (!(e > 0)) throw std::invalid_argument("Young's modulus has to be positive");
    if (!(nu >= 0 && nu < 0.5))
        throw std::invalid_argument("Poisson's ratio has to be in [0, 0.5)");
    return {.shear_pa = e / (2 * (1 + nu)), .volume_pa = e * nu / ((1 + nu) * (1 - 2 * nu))};
}

IsotropicModuli moduli_of_bulk(double mu, double b) {
    if (!(mu > 0)) throw std::invalid_argument("the shear modulus has to be positive");
    const double k = b - 2.0 / 3.0 * mu;
    if (!(k >= 0))
        throw std::invalid_argument("the bulk modulus has to be at least 2/3 of the shear modulus");
    return {.shear_pa = mu, .volume_pa = k};
}

Mat3 block_tensor(double modulus, const Vec3& edges_m) { return modulus * block_scale(edges_m); }

Mat3 block_moduli(const Mat3& tensor, const Vec3& edges_m) {
    return tensor.cwiseQuotient(block_scale(edges_m));
}

double incompressibility(double volume_modulus_pa, double rest_volume_m3) {
    return volume_modulus_pa / (2 * rest_volume_m3);
}

double volume_modulus(double incompressibility_n_per_m5, double rest_volume_m3) {
    return 2 * incompressibility_n_per_m5 * rest_volume_m3;
}

double nodal_incompressibility(double volume_modulus_pa, double rest_volume_m3,
                               const GridShape& grid) {
    return incompressibility(volume_modulus_pa, rest_volume_m3) / cells(grid);
}

double nodal_volume_modulus(double incompressibility_n_per_m5, double rest_volume_m3,
                            const GridShape& grid) {
    return volume_modulus(incompressibility_n_per_m5, rest_volume_m3) * cells(grid);
}

double nodal_shear_fraction(const GridShape& grid, int i, int j) {
    return 1 - 0.5 * (1.0 / grid.along(i) + 1.0 / grid.along(j));
}

}  // namespace risorius::tissue
