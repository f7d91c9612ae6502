// SPDX-License-Identifier: MIT
// Adaptive resolution of surfaces: bisection preserves the mesh and the material, and the estimate knows where to refine.
#include "risorius/tissue/detail/refine_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "risorius/solve/newton.h"

namespace risorius::tissue {
namespace {

/// A square metre of isotropic sheet, with material coordinates in metres.
TriangleSurface sheet(int nodes, double bending_n_m = 0) {
    GridSurface grid;
    grid.grid = {nodes, nodes};
    grid.rest = sheet_rest(grid.grid, Vec2(1, 1));
    grid.material = {isotropic_surface(100, 0, bending_n_m, 2, 0)};
    return triangulated(grid);
}

std::vector<char> marks(const TriangleSurface& surface, const std::vector<int>& triangles) {
    std::vector<char> marked(static_cast<std::size_t>(surface.triangles.rows()), 0);
    for (const int t : triangles) marked[static_cast<std::size_t>(t)] = 1;
    return marked;
}

double area_by(const TriangleSurface& surface) {
    double sum = 0;
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
        sum += area_of(coordinates_of(surface, t));
    return sum;
}

/// Every inner edge has two triangles that run along it in opposite directions, and no node lies inside an edge.
void expect_conforming(const TriangleSurface& surface) {
    std::map<std::pair<int, int>, int> runs;
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            ++runs[{surface.triangles(t, k), surface.triangles(t, (k + 1) % 3)}];
    for (const auto& [edge, count] : runs) {
        EXPECT_EQ(count, 1) << "each direction once";
        if (runs.contains({edge.second, edge.first})) continue;
        const auto on_border = [&](int node) {
            const auto p = surface.rest.row(node);
            return p[0] == 0 || p[0] == 1 || p[1] == 0 || p[1] == 1;
        };
        EXPECT_TRUE(on_border(edge.first) && on_border(edge.second)) << "a gap inside";
    }
}

double smallest_angle(const TriangleSurface& surface) {
    double min = 4;
    for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = surface.rest.row(surface.triangles(t, k)).transpose();
            const Vec3 u = surface.rest.row(surface.triangles(t, (k + 1) % 3)).transpose() - p;
            const Vec3 v = surface.rest.row(surface.triangles(t, (k + 2) % 3)).transpose() - p;
            min = std::min(min, std::atan2(u.cross(v).norm(), u.dot(v)));
        }
    return min;
}

TEST(Bisection, KeepsTheMeshConformingAndItsAngles) {
    TriangleSurface surface = sheet(4);
    for (const int node : {5, 6, 9, 10})
        surface.rest.row(node) += Eigen::RowVector3d(0.04, -0.06, 0);
    surface.coordinates =
        fibre_coordinates(surface.triangles, surface.rest,
                          Vec3::UnitX().transpose().replicate(surface.triangles.rows(), 1));
    const double angle = smallest_angle(surface), area = area_by(surface);
    for (int round = 0; round < 6; ++round) {
        const Bisected next = bisected(surface, marks(surface, {0, 7}));
        EXPECT_GT(next.surface.triangles.rows(), surface.triangles.rows());
        EXPECT_EQ(next.surface.rest.rows(),
                  surface.rest.rows() + static_cast<Eigen::Index>(next.middle_of.size()));
        surface = next.surface;
        expect_conforming(surface);
        EXPECT_NEAR(area_by(surface), area, 1e-12);
        EXPECT_GE(smallest_angle(surface), angle / 2 - 1e-12);
    }
    EXPECT_NO_THROW(check(surface, "sheet"));
}

TEST(Bisection, PartsHaveTheMaterialOfTheWhole) {
    TriangleSurface surface = sheet(3);
    surface.material.resize(1);
    for (int t = 1; t < 8; ++t)
        surface.material.push_back(isotropic_surface(100 + t, 0, 0, 1 + t, 0));
    const double mass = node_mass(surface).sum();
    const Bisected next = bisected(surface, marks(surface, {0, 1, 5}));
    ASSERT_EQ(next.surface.material.size(), next.parent.size());
    for (std::size_t t = 0; t < next.parent.size(); ++t)
        EXPECT_EQ(next.surface.material[t].mass_kg,
                  surface.material[static_cast<std::size_t>(next.parent[t])].mass_kg);
    EXPECT_NEAR(node_mass(next.surface).sum(), mass, 1e-12 * mass);
    // Nothing is marked, so nothing changes.
    EXPECT_EQ(bisected(surface, marks(surface, {})).surface.triangles, surface.triangles);
}

Points mapped(const Points& rest, const std::function<Vec3(const Vec3&)>& map) {
    Points x = rest;
    for (Eigen::Index i = 0; i < x.rows(); ++i) x.row(i) = map(rest.row(i).transpose()).transpose();
    return x;
}

const auto kLinear = [](const Vec3& p) -> Vec3 {
    return {1.2 * p[0] + 0.1 * p[1], 0.9 * p[1] - 0.05 * p[0], 0.3 * p[0] + 0.2 * p[1]};
};

TEST(AdaptiveSurface, LinearStatesAndTheirEnergyAreUnchangedByRefinement) {
    AdaptiveSurface adaptive(sheet(4, 0.01), {.tolerance = 1e-6});
    solve::MotionState state = adaptive.start();
    EXPECT_FALSE(adaptive.refine(state)) << "at rest";
    state.x = mapped(adaptive.surface().rest, kLinear);
    state.v = mapped(adaptive.surface().rest, kLinear);
    EXPECT_FALSE(adaptive.refine(state)) << "a linear deformation has no error";
    EXPECT_LT(adaptive.estimated_error(), 1e-12);
    const double energy = adaptive.term()->energy(0, state.x);
    const double mass = node_mass(adaptive.surface()).sum();
    EXPECT_TRUE(adaptive.refine_where([](int triangle) { return triangle < 3; }, &state));
    EXPECT_TRUE(adaptive.refine_where([](int triangle) { return triangle < 5; }, &state));
    EXPECT_NEAR(adaptive.term()->energy(0, state.x), energy, 1e-12 * energy);
    EXPECT_NEAR(node_mass(adaptive.surface()).sum(), mass, 1e-12 * mass);
    EXPECT_LT((state.x - mapped(adaptive.surface().rest, kLinear)).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_EQ(state.v, state.x);
}

TEST(AdaptiveSurface, BisectionsOfATriangleAreLimited) {
    AdaptiveSurface adaptive(sheet(2), {.max_bisections = 3});
    const auto all = [](int) { return true; };
    int rounds = 0;
    while (rounds < 10 && adaptive.refine_where(all)) ++rounds;
    EXPECT_EQ(rounds, 3);
    EXPECT_EQ(adaptive.surface().triangles.rows(), 2 * 8);
}

TEST(SurfaceError, FallsWithTheSizeAndIsNearTheTrueError) {
    // G - G0 of x = (s + c s^2, t, 0) is (2 c s (2 + 2 c s), 0, 0). In triangles between nodes it is constant.
    constexpr double kC = 0.2;
    double before = 0;
    for (const int nodes : {9, 17}) {
        const TriangleSurface surface = sheet(nodes);
        const TriangleSheetTerm term(surface);
        const Points x = mapped(surface.rest, [](const Vec3& p) -> Vec3 {
            return {p[0] + kC * p[0] * p[0], p[1], 0};
        });
        const double estimate = squared_error(surface, term, x).sum();
        const int links = nodes - 1;
        double truth = 0;
        for (int i = 0; i < links; ++i) {
            const double s0 = static_cast<double>(i) / links, h = 1.0 / links;
            const double slope = 1 + kC * (2 * s0 + h);
            for (int p = 0; p < 100; ++p) {
                const double exact = 1 + 2 * kC * (s0 + h * (p + 0.5) / 100);
                truth += 0.25 * 100 * std::pow(exact * exact - slope * slope, 2) * h / 100;
            }
        }
        const double effectivity = std::sqrt(estimate / truth);
        EXPECT_GT(effectivity, 0.7) << nodes;
        EXPECT_LT(effectivity, 1.4) << nodes;
        if (before > 0) {
            EXPECT_NEAR(std::log2(std::sqrt(before / estimate)), 1, 0.1);
        }
        before = estimate;
    }
}

TEST(SurfaceError, ConstantCurvatureHasNoErrorInsideAndChangingCurvatureHas) {
    TriangleSurface limp = sheet(13);
    limp.material = {isotropic_surface(0, 0, 0.01, 2, 0)};  // bending only
    const TriangleSheetTerm term(limp);
    const auto fraction = [&](const std::function<double(double)>& height) {
        const Points x = mapped(limp.rest, [&](const Vec3& p) -> Vec3 {
            return {p[0], p[1], height(p[0])};
        });
        const Eigen::VectorXd squared = squared_error(limp, term, x);
        double inside = 0;  // a triangle at the border lacks folds
        for (Eigen::Index t = 0; t < squared.size(); ++t) {
            const Vec2 middle = coordinates_of(limp, t).rowwise().mean();
            if ((middle.array() - 0.5).abs().maxCoeff() < 0.3) inside += squared[t];
        }
        return inside / term.energy(0, x);
    };
    EXPECT_LT(fraction([](double s) { return 1e-3 * s * s; }), 1e-5);
    EXPECT_GT(fraction([](double s) { return 1e-3 * std::sin(9 * s); }), 0.01);
}

/// A sheet that is held at its border. A patch of 1/4 x 1/4 in its middle is pushed out by 0.3 m. It begins with a stretch of 5
/// %.
struct PokedSheet {
    double multiplications = 0;
    double assembled = 0;  ///< number of second derivatives of a triangle

    static bool is_patch(const Eigen::RowVector3d& p) {
        return (p.head<2>().array() - 0.5).abs().maxCoeff() < 0.125 + 1e-9;
    }
    bool operator()(const AdaptiveSurface& surface, SolveStage stage, solve::MotionState& state) {
        const Points& rest = surface.surface().rest;
        std::vector<char> fixed(static_cast<std::size_t>(rest.rows()), 0);
        for (Eigen::Index i = 0; i < rest.rows(); ++i) {
            const bool border =
                rest.row(i).head<2>().minCoeff() == 0 || rest.row(i).head<2>().maxCoeff() == 1;
            if (!border && !is_patch(rest.row(i))) continue;
            fixed[static_cast<std::size_t>(i)] = 1;
            state.x.row(i) = 1.05 * rest.row(i);
            if (!border) state.x(i, 2) = 0.3;
        }
        solve::MotionSystem system(node_mass(surface.surface()), fixed);
        system.add(surface.term());
        const Points start = state.x;
        const auto report = solve::Newton().solve_equilibrium(
            system, {.end_s = 0, .step_s = std::numeric_limits<double>::infinity(), .start = start},
            {.iterations = 100,
             .tolerance_m = stage == SolveStage::kFinal ? 1e-6 : 1e-3,
             .linear = solve::LinearSolver::kConjugate,
             .first_step_s = 30},
            state.x);
        multiplications += report.multiplications;
        assembled += static_cast<double>(surface.surface().triangles.rows() * report.linear_solves);
        return report.converged;
    }
    static double push(const AdaptiveSurface& surface, const Points& x) {
        Points force = Points::Zero(x.rows(), 3);
        surface.term()->add_force(0, x, Points::Zero(x.rows(), 3), force);
        double sum = 0;
        for (Eigen::Index i = 0; i < x.rows(); ++i)
            if (is_patch(surface.surface().rest.row(i))) sum -= force(i, 2);
        return sum;
    }
};

TEST(AdaptiveSurface, PokedSheetNeedsLessThanHalfTheWorkOfAUniformOne) {
    const SurfaceRefineOptions options{.tolerance = 0.1, .max_bisections = 6};
    AdaptiveSurface uniform(sheet(9), options);
    PokedSheet solve_uniform;
    solve::MotionState uniform_state = uniform.start();
    do {
        ASSERT_TRUE(solve_uniform(uniform, SolveStage::kIntermediate, uniform_state));
    } while (uniform.refine_where([](int) { return true; }, &uniform_state));
    ASSERT_TRUE(solve_uniform(uniform, SolveStage::kFinal, uniform_state));

    AdaptiveSurface adaptive(sheet(9), options);
    PokedSheet solve;
    solve::MotionState state = adaptive.start();
    const RefineRounds rounds = solve_and_refine(adaptive, std::ref(solve), 7, state);
    EXPECT_TRUE(rounds.converged);
    const double fine = PokedSheet::push(uniform, uniform_state.x);
    EXPECT_NEAR(PokedSheet::push(adaptive, state.x) / fine, 1, 0.01);
    EXPECT_LT(solve.multiplications, 0.25 * solve_uniform.multiplications);
    EXPECT_LT(solve.assembled, 0.5 * solve_uniform.assembled);
    // Near a corner of the patch the triangles are small; near a corner of the sheet they are not.
    double near = 1, far = 1;
    for (Eigen::Index t = 0; t < adaptive.surface().triangles.rows(); ++t) {
        const Vec2 middle = coordinates_of(adaptive.surface(), t).rowwise().mean();
        const double area = area_of(coordinates_of(adaptive.surface(), t));
        if ((middle - Vec2(0.375, 0.375)).norm() < 0.05) near = std::min(near, area);
        if (middle.norm() < 0.1) far = std::min(far, area);
    }
    EXPECT_LE(near, far / 4);
}

TEST(AdaptiveSurface, OptionsOutsideTheirRangesAreNamed) {
    const auto message = [](const SurfaceRefineOptions& options) -> std::string {
        try {
            AdaptiveSurface(sheet(2), options);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(message({.tolerance = 0}),
              "SurfaceRefineOptions: tolerance: expected (0, 1), found 0");
    EXPECT_EQ(message({.max_bisections = -1}),
              "SurfaceRefineOptions: most_bisections: expected [0, 16], found -1");
}

}  // namespace
}  // namespace risorius::tissue
