// SPDX-License-Identifier: MIT
/// \file
/// The thesis' cube under a ceiling (figures 5 and 9), and its equilibrium by Newton's method.
///
/// L = 3 m and g = 9.81 m/s^2 are inferred: with them the published figures are reproduced. The plane of highest a3 is held.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <limits>
#include <memory>
#include <numeric>

#include "risorius/solve/motion_system.h"
#include "risorius/tissue/gravity.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::tissue {

constexpr double kCubeEdge = 3;

inline GridSolid hanging_cube(int nodes_per_edge, const SolidMaterial& material,
                              Parameters parameters = Parameters::kResolutionIndependent) {
    const GridShape grid{nodes_per_edge, nodes_per_edge, nodes_per_edge};
    return {grid, block_rest(grid, Vec3::Constant(kCubeEdge)), {material}, parameters};
}

/// `Solid` is a term made from a GridSolid. The ceiling holds the highest plane of a3.
template <class Solid>
solve::MotionSystem hang(const GridSolid& solid) {
    std::vector<char> fixed(static_cast<std::size_t>(solid.grid.size()), 0);
    for (const int node : plane_nodes(solid.grid, 2, solid.grid.o - 1))
        fixed[static_cast<std::size_t>(node)] = 1;
    const Eigen::VectorXd mass = node_mass(solid);
    solve::MotionSystem system(mass, fixed);
    system.add(std::make_shared<Solid>(solid));
    system.add(std::make_shared<Gravity>(mass));
    return system;
}

/// Newton's method with halved steps, until no node moves by 1e-10 m. The exact second derivative is used where it is positive,
/// as near the end, where it converges fastest. Elsewhere its positive part is used, which leads downhill from anywhere.
inline Points equilibrium(const solve::MotionSystem& system, const Points& start) {
    const solve::ImplicitStep still{
        .end_s = 0, .step_s = std::numeric_limits<double>::infinity(), .start = start};
    Points x = start, gradient, ignored;
    for (int iteration = 0; iteration < 200; ++iteration) {
        const double potential = system.potential(still, x, gradient);
        Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver;
        for (const auto curvature : {solve::Curvature::kExact, solve::Curvature::kPositive}) {
            solve::HessianBuilder hessian(system.size(), system.fixed());
            system.add_hessian(still, x, curvature, hessian);
            solver.compute(hessian.build());
            if (solver.info() == Eigen::Success) break;
        }
        if (solver.info() != Eigen::Success) break;
        const Eigen::VectorXd slope =
            Eigen::Map<const Eigen::VectorXd>(gradient.data(), gradient.size());
        const Eigen::VectorXd direction = -solver.solve(slope);
        const Points move = Eigen::Map<const Points>(direction.data(), x.rows(), 3);
        if (move.cwiseAbs().maxCoeff() < 1e-10) return x + move;
        double fraction = 1;
        while (fraction > 1e-6 && system.potential(still, x + fraction * move, ignored) >
                                      potential + 1e-4 * fraction * slope.dot(direction))
            fraction /= 2;
        x += fraction * move;
    }
    ADD_FAILURE() << "no equilibrium was found";
    return x;
}

/// Mean depth of the lowest plane below the ceiling, as a fraction of the edge.
inline double hang_length(const GridShape& grid, const Points& x) {
    const auto mean_height = [&](int index) {
        double sum = 0;
        const auto nodes = plane_nodes(grid, 2, index);
        for (const int node : nodes) sum += x(node, 2);
        return sum / static_cast<double>(nodes.size());
    };
    return (mean_height(grid.o - 1) - mean_height(0)) / kCubeEdge;
}

inline double volume_change(const GridSolid& solid, const Points& x) {
    return enclosed_volume(solid.grid, x) / enclosed_volume(solid.grid, solid.rest) - 1;
}

/// Hanging length of a bar of the metric term alone, as a fraction of L. It is exact for finite differences: link k from the
/// free end carries T_k = m g k / M, and its stretch solves s^3 - s = T_k / (lambda L^3).
inline double closed_form_hang_length(int nodes, double elastic_n_per_m3, double mass_kg) {
    const double edge_cubed = kCubeEdge * kCubeEdge * kCubeEdge;
    double sum = 0;
    for (int k = 1; k < nodes; ++k) {
        const double pull =
            mass_kg * kStandardGravity * k / nodes / (elastic_n_per_m3 * edge_cubed);
        double s = 2;
        for (int i = 0; i < 60; ++i) s -= (s * s * s - s - pull) / (3 * s * s - 1);
        sum += s;
    }
    return sum / (nodes - 1);
}

}  // namespace risorius::tissue
