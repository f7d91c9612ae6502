// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/thick_plate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "risorius/figures/detail/problem_setup.h"
#include "risorius/tissue/cell_solid.h"

namespace risorius::figures {
namespace {

using tissue::GridShape;

constexpr double kThickness = 0.6;
constexpr double kPressure = 1.0 / 210'000;  // over Young's modulus

/// a1 goes outward, a2 from the x axis to the y axis, a3 upwards.
Vec3 ring(const Vec3& a) {
    const double angle = a[1] * std::numbers::pi / 2, c = std::cos(angle), s = std::sin(angle);
    return {(2 + 1.25 * a[0]) * c, (1 + 1.75 * a[0]) * s, kThickness * (a[2] - 0.5)};
}

void support(const GridShape& grid, ProblemSetup& setup) {
    for (int m = 0; m < grid.m; ++m)
        for (int n = 0; n < grid.n; ++n)
            for (int o = 0; o < grid.o; ++o) {
                const int node = grid.index(m, n, o);
                const bool outer = m == grid.m - 1;
                if (outer || n == grid.n - 1) setup.guide(node, 0);
                if (outer || n == 0) setup.guide(node, 1);
                if (outer && 2 * o == grid.o - 1) setup.guide(node, 2);
            }
}

/// Pressure on the upper face, by 2 x 2 Gauss points of each of its flat quadrilaterals.
void press(const GridShape& grid, double pressure_pa, ProblemSetup& setup) {
    for (int m = 0; m + 1 < grid.m; ++m)
        for (int n = 0; n + 1 < grid.n; ++n) {
            std::array<int, 4> node{};
            std::array<Vec3, 4> at;
            for (std::size_t c = 0; c < 4; ++c) {
                node[c] = grid.index(m + static_cast<int>(c / 2), n + static_cast<int>(c % 2),
                                     grid.o - 1);
                at[c] = setup.rest().row(node[c]).transpose();
            }
            for (int g = 0; g < 4; ++g) {
                const double off = 0.5 / std::sqrt(3.0), s = 0.5 + (g / 2 ? off : -off),
                             t = 0.5 + (g % 2 ? off : -off);
                const Vec3 along = (1 - t) * (at[2] - at[0]) + t * (at[3] - at[1]),
                           around = (1 - s) * (at[1] - at[0]) + s * (at[3] - at[2]);
                const Vec3 force(0, 0, -0.25 * pressure_pa * along.cross(around).norm());
                for (std::size_t c = 0; c < 4; ++c) {
                    const double weight = (c / 2 ? s : 1 - s) * (c % 2 ? t : 1 - t);
                    setup.loads.push_back({node[c], weight * force});
                }
            }
        }
}

/// sigma_yy at the centre of a cell, for small strains.
double stress_in(const tissue::CellSolid& solid, const Points& x, const Eigen::VectorXd& volumes,
                 const Eigen::VectorXd& rest_volumes, int cell) {
    const tissue::CellModuli& moduli = solid.body().moduli[static_cast<std::size_t>(cell)];
    const Mat3 f = solid.deformation_gradient(x, cell);
    return 2 * moduli.mu_pa * (f(1, 1) - 1) +
           moduli.bulk_pa * (volumes[cell] / rest_volumes[cell] - 1);
}

}  // namespace

double thick_plate(const KnownMaterial& material, int cells) {
    const GridShape grid{2 * cells + 1, 3 * cells + 1, cells + 1};
    ProblemSetup setup(grid, ring, material);
    support(grid, setup);
    press(grid, kPressure * material.young_pa, setup);
    setup.settle();

    // Linear extrapolation from the two layers of cells next to the point along each axis
    const tissue::CellSolid solid(setup.body);
    const Eigen::VectorXd volumes = solid.cell_volumes(setup.x),
                          rest_volumes = solid.cell_volumes(setup.rest());
    const auto cell_at = [&](const std::array<int, 3>& place) {
        const std::vector<tissue::CellMesh::Cell>& list = setup.body.mesh.cells();
        const auto found = std::find_if(list.begin(), list.end(),
                                        [&](const auto& cell) { return cell.place.at == place; });
        return static_cast<int>(found - list.begin());
    };
    double stress = 0;
    for (int corner = 0; corner < 8; ++corner) {
        std::array<int, 3> place{};
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const int inward = corner >> axis & 1;
            place[static_cast<std::size_t>(axis)] =
                axis == 2 ? grid.cells(axis) - 1 - inward : inward;
            weight *= inward ? -0.5 : 1.5;
        }
        stress += weight * stress_in(solid, setup.x, volumes, rest_volumes, cell_at(place));
    }
    return -stress / (kPressure * material.young_pa);
}

}  // namespace risorius::figures
