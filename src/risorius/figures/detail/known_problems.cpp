// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/known_problems.h"

#include <cmath>
#include <numbers>

#include "risorius/figures/detail/problem_setup.h"
#include "risorius/figures/detail/thick_plate.h"
#include "risorius/tissue/moduli.h"

namespace risorius::figures {
namespace {

using tissue::CellMesh;
using tissue::GridShape;

constexpr double kSlender = 10;  // length of bars over their edge or radius

void load_end(const GridShape& grid, const Vec3& force, ProblemSetup& setup) {
    setup.load_plane(grid, grid.m - 1, force);
}

void clamp_start(const GridShape& grid, ProblemSetup& setup) {
    for (int n = 0; n < grid.n; ++n)
        for (int o = 0; o < grid.o; ++o) setup.fix(grid.index(0, n, o));
}

/// Deflection per force of Timoshenko's cantilever, m/N.
double timoshenko(const KnownMaterial& material) {
    const double inertia = 1.0 / 12, nu = material.poisson_ratio;
    const double shape = 10 * (1 + nu) / (12 + 11 * nu);
    return std::pow(kSlender, 3) / (3 * material.young_pa * inertia) +
           kSlender / (shape * material.shear_pa());
}

/// How far the nodes of a plane of a1 have risen on average.
double rise(const GridShape& grid, int plane, const ProblemSetup& setup) {
    double sum = 0;
    for (int n = 0; n < grid.n; ++n)
        for (int o = 0; o < grid.o; ++o) {
            const int node = grid.index(plane, n, o);
            sum += setup.x(node, 2) - setup.rest()(node, 2);
        }
    return sum / (grid.n * grid.o);
}

constexpr double kDeflection = 1e-3 * kSlender;

double cantilever(const KnownMaterial& material, int cells) {
    const GridShape grid{static_cast<int>(kSlender) * cells * material.lengthwise + 1, cells + 1,
                         cells + 1};
    ProblemSetup setup(
        grid, [](const Vec3& a) { return Vec3(kSlender * a[0], a[1], a[2]); }, material);
    clamp_start(grid, setup);
    load_end(grid, Vec3(0, 0, kDeflection / timoshenko(material)), setup);
    setup.settle();
    return rise(grid, grid.m - 1, setup) / kDeflection;
}

/// Two cantilevers back to back, in balance: no section is kept from changing its shape, as a clamp would.
double bar(const KnownMaterial& material, int cells) {
    const int middle = static_cast<int>(kSlender) * cells;
    const GridShape grid{2 * middle + 1, cells + 1, cells + 1};
    ProblemSetup setup(
        grid, [](const Vec3& a) { return Vec3(2 * kSlender * a[0], a[1], a[2]); }, material);
    const Vec3 force(0, 0, kDeflection / timoshenko(material));
    setup.load_plane(grid, 0, force);
    setup.load_plane(grid, middle, -2 * force);
    setup.load_plane(grid, 2 * middle, force);
    setup.fix(grid.index(middle, cells / 2, cells / 2));  // bears nothing
    setup.settle();
    const double ends = 0.5 * (rise(grid, 0, setup) + rise(grid, 2 * middle, setup));
    return (ends - rise(grid, middle, setup)) / kDeflection;
}

double cook(const KnownMaterial& material, int cells) {
    const GridShape grid{cells + 1, cells + 1, 2};
    const auto panel = [](const Vec3& a) {
        return Vec3(48 * a[0], 44 * a[0] + (44 - 28 * a[0]) * a[1], a[2]);
    };
    ProblemSetup setup(grid, panel, material);
    clamp_start(grid, setup);
    const double force = 1e-4 * material.young_pa;
    load_end(grid, Vec3(0, force, 0), setup);
    setup.settle();
    const int node = grid.index(grid.m - 1, cells / 2, 0);
    return (setup.x(node, 1) - setup.rest()(node, 1)) * material.young_pa / force;
}

double patch(const KnownMaterial& material, int cells) {
    const GridShape grid{cells + 1, cells + 1, cells + 1};
    // Inner nodes are moved by up to a fifth of a cell
    const auto distorted = [&](const Vec3& a) -> Vec3 {
        const double inside = a.minCoeff() > 1e-9 && a.maxCoeff() < 1 - 1e-9 ? 0.2 / cells : 0;
        const Vec3 phase =
            2 * std::numbers::pi * cells * Vec3(0.31 * a[1], 0.47 * a[2], 0.59 * a[0]);
        return a + inside * (phase.array() + 1).sin().matrix();
    };
    ProblemSetup setup(grid, distorted, material);
    Mat3 f;
    f << 1.1, 0.2, -0.05, -0.15, 0.95, 0.1, 0.05, -0.1, 1.05;
    const Points goal = setup.rest() * f.transpose();
    for (int m = 0; m < grid.m; ++m)
        for (int n = 0; n < grid.n; ++n)
            for (int o = 0; o < grid.o; ++o) {
                const int node = grid.index(m, n, o);
                const bool border = m % cells == 0 || n % cells == 0 || o % cells == 0;
                if (border) setup.fix(node);
                setup.x.row(node) = goal.row(node);
                if (!border) setup.x.row(node).array() += 0.02 / cells;
            }
    setup.settle();
    return (setup.x - goal).rowwise().norm().maxCoeff();
}

double torsion(const KnownMaterial& material, int cells) {
    const GridShape grid{static_cast<int>(kSlender) * cells / 2 + 1, cells + 1, cells + 1};
    const auto round = [](const Vec3& a) {
        const double y = 2 * a[1] - 1, z = 2 * a[2] - 1;
        return Vec3(kSlender * a[0], y * std::sqrt(1 - z * z / 2), z * std::sqrt(1 - y * y / 2));
    };
    ProblemSetup setup(grid, round, material);
    clamp_start(grid, setup);
    const double twist = 1e-3;
    for (int n = 0; n < grid.n; ++n)
        for (int o = 0; o < grid.o; ++o) {
            const int node = grid.index(grid.m - 1, n, o);
            setup.fix(node);
            const double y = setup.rest()(node, 1), z = setup.rest()(node, 2);
            setup.x(node, 1) = y * std::cos(twist) - z * std::sin(twist);
            setup.x(node, 2) = y * std::sin(twist) + z * std::cos(twist);
        }
    setup.settle();
    const Points force = setup.holding();
    double torque = 0;
    for (int n = 0; n < grid.n; ++n)
        for (int o = 0; o < grid.o; ++o) {
            const int node = grid.index(grid.m - 1, n, o);
            torque += setup.x(node, 1) * force(node, 2) - setup.x(node, 2) * force(node, 1);
        }
    return torque / (material.shear_pa() * std::numbers::pi / 2 * twist / kSlender);
}

/// The displacement of the manufactured solution on the unit cube.
Vec3 given_displacement(const Vec3& at) {
    constexpr double kSize = 0.05;
    const double pi = std::numbers::pi, x = at[0], y = at[1], z = at[2];
    return kSize * Vec3(std::sin(pi * x) * std::sin(pi * y) * z, std::sin(pi * y) * x * (1 - z),
                        std::cos(pi * x) * std::sin(pi * z) * y);
}

Mat3 given_gradient(const Vec3& at) {
    constexpr double kStep = 1e-3;
    Mat3 f = Mat3::Identity();
    for (int k = 0; k < 3; ++k) {
        // Fourth order
        const auto u = [&](double s) { return given_displacement(at + s * kStep * Vec3::Unit(k)); };
        f.col(k) += (8 * (u(1) - u(-1)) - (u(2) - u(-2))) / (12 * kStep);
    }
    return f;
}

/// - Div P of the given displacement, for the law of cell_body.h: P = mu F (F^T F - I) + K (J - 1) cof F.
Vec3 given_body_force(const Vec3& at, const tissue::CellModuli& moduli) {
    constexpr double kStep = 1e-2;
    const auto stress = [&](const Vec3& point) -> Mat3 {
        const Mat3 f = given_gradient(point);
        const double j = f.determinant();
        return moduli.mu_pa * f * (f.transpose() * f - Mat3::Identity()) +
               moduli.bulk_pa * (j - 1) * j * f.inverse().transpose();
    };
    Vec3 divergence = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
        const auto column = [&](double s) -> Vec3 {
            return stress(at + s * kStep * Vec3::Unit(k)).col(k);
        };
        divergence += (8 * (column(1) - column(-1)) - (column(2) - column(-2))) / (12 * kStep);
    }
    return -divergence;
}

double manufactured(const KnownMaterial& material, int cells) {
    const GridShape grid{cells + 1, cells + 1, cells + 1};
    ProblemSetup setup(
        grid, [](const Vec3& a) -> Vec3 { return a; }, material);
    Points goal = setup.rest();
    for (long node = 0; node < goal.rows(); ++node) {
        const Vec3 at = setup.rest().row(node).transpose();
        goal.row(node) += given_displacement(at).transpose();
        if (at.minCoeff() < 1e-9 || at.maxCoeff() > 1 - 1e-9) {
            setup.fix(static_cast<int>(node));
            setup.x.row(node) = goal.row(node);
        }
    }
    // Work of the body force on each corner, by 2 x 2 x 2 Gauss points
    const tissue::CellModuli moduli = material.moduli();
    const double h = 1.0 / cells, volume = h * h * h / 8, off = 1 / std::sqrt(3.0);
    for (const CellMesh::Cell& cell : setup.body.mesh.cells())
        for (int g = 0; g < 8; ++g) {
            Vec3 place;
            for (int k = 0; k < 3; ++k) place[k] = 0.5 * (1 + (g & (4 >> k) ? off : -off));
            const Vec3 force = volume * given_body_force(cell.low + h * place, moduli);
            for (int c = 0; c < 8; ++c) {
                double weight = 1;
                for (int k = 0; k < 3; ++k) weight *= c & (4 >> k) ? place[k] : 1 - place[k];
                setup.loads.push_back({cell.vertex[static_cast<std::size_t>(c)], weight * force});
            }
        }
    setup.settle();
    return (setup.x - goal).norm() / (goal - setup.rest()).norm();
}

}  // namespace

tissue::CellModuli KnownMaterial::moduli() const {
    const tissue::IsotropicModuli of = tissue::moduli_of_young(young_pa, poisson_ratio);
    return {.mu_pa = of.shear_pa, .bulk_pa = of.volume_pa, .viscosity_pa_s = 0};
}

const std::vector<KnownProblem>& known_problems() {
    static const std::vector<KnownProblem> kList{
        {"cantilever", "deflection_ratio", 1, true, cantilever},
        {"bar", "deflection_ratio", 1, true, bar},
        {"thick-plate", "stress", 5.38, false, thick_plate},  // NAFEMS LE10
        {"cook", "tip", 23.96, false, cook},  // Simo & Rifai 1990, plane stress with nu = 1/3
        {"patch", "error", 0, false, patch},
        {"torsion", "torque_ratio", 1, false, torsion},
        {"manufactured", "error", 0, true, manufactured},
    };
    return kList;
}

}  // namespace risorius::figures
