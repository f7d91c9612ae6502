// SPDX-License-Identifier: MIT
/// \file
/// Solids of cells for several tests: the thesis' cube, random, bent and refined.
#pragma once

#include <cmath>
#include <random>

#include "risorius/solve/motion_system.h"
#include "risorius/tissue/cell_solid.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::tissue::cell_solids {

constexpr double kSide = 3.0;    // m, the thesis' cube
constexpr double kMass = 4.0;    // kg
constexpr double kLambda = 1.5;  // N/m^3

/// The thesis' cube, with the volume parameter of the continuum.
inline GridSolid thesis_cube(int nodes, double psi, double damping = 0.0) {
    GridSolid solid;
    solid.grid = {nodes, nodes, nodes};
    solid.rest = block_rest(solid.grid, Vec3::Constant(kSide));
    solid.material = {isotropic_material(kLambda, damping, psi, kMass, 0.0)};
    return solid;
}

/// An inhomogeneous, anisotropic, damped solid whose rest shape is not a block.
inline GridSolid varied_solid(const GridShape& grid) {
    GridSolid solid;
    solid.grid = grid;
    solid.rest = block_rest(grid, Vec3(1.0, 1.3, 0.7));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> fraction(0.0, 1.0);
    for (Eigen::Index i = 0; i < solid.rest.size(); ++i)
        solid.rest.data()[i] += 0.04 * (fraction(random) - 0.5);
    for (int node = 0; node < grid.size(); ++node) {
        SolidMaterial material;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j <= i; ++j) {
                material.elastic_n_per_m3(i, j) = material.elastic_n_per_m3(j, i) =
                    1.0 + fraction(random);
                material.damping_ns_per_m3(i, j) = material.damping_ns_per_m3(j, i) =
                    0.1 * fraction(random);
            }
        material.incompressibility_n_per_m5 = 5 + 5 * fraction(random);
        material.mass_kg = 1 + fraction(random);
        solid.material.push_back(material);
    }
    return solid;
}

inline Points jolted(Points x, double amplitude, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shake(-amplitude, amplitude);
    for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] += shake(random);
    return x;
}

/// Root cells. The one at a = 0 and its neighbour along a3 are split once, and one of the children is split again.
inline CellMesh refined_mesh() {
    const GridShape root{4, 4, 4};
    std::vector<CellPlace> cells;
    const auto split = [](const CellPlace& parent) {
        std::vector<CellPlace> parts;
        for (int c = 0; c < 8; ++c)
            parts.push_back({parent.level + 1,
                             {2 * parent.at[0] + (c >> 2 & 1), 2 * parent.at[1] + (c >> 1 & 1),
                              2 * parent.at[2] + (c & 1)}});
        return parts;
    };
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) {
                const CellPlace place{0, {i, j, k}};
                if (i > 1 || j > 1 || k > 1) {
                    cells.push_back(place);
                    continue;
                }
                for (const CellPlace& part : split(place)) {
                    if (i + j + k == 0 && part.at == std::array<int, 3>{0, 0, 0})
                        for (const CellPlace& small : split(part)) cells.push_back(small);
                    else
                        cells.push_back(part);
                }
            }
    return {root, cells};
}

/// A section of a bent tube: no cell is a parallelepiped.
inline Vec3 bent(const Vec3& a) {
    const double angle = 0.8 * a[0], radius = 0.08 - 0.03 * a[1];
    return {radius * std::sin(angle), 0.08 - radius * std::cos(angle), 0.04 * a[2] + 0.004 * a[1]};
}

}  // namespace risorius::tissue::cell_solids
