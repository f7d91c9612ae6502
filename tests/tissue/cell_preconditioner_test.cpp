// SPDX-License-Identifier: MIT
#include "risorius/tissue/cell_preconditioner.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "cell_solids.h"
#include "risorius/core/dense_algebra.h"
#include "risorius/solve/integrator.h"
#include "risorius/solve/real_time_step.h"
#include "risorius/tissue/gravity.h"

namespace risorius::tissue {
namespace {

constexpr double kStep = 1.0 / 60;

/// A solid of cells that hangs from its highest plane of a3 under gravity.
struct Hanging {
    std::shared_ptr<const CellSolid> solid;
    solve::MotionSystem system;

    explicit Hanging(CellBody body)
        : solid(std::make_shared<CellSolid>(std::move(body))),
          system(solid->body().mass_kg, held(solid->mesh())) {
        system.add(std::const_pointer_cast<CellSolid>(solid));
        system.add(std::make_shared<Gravity>(solid->body().mass_kg));
    }
    static std::vector<char> held(const CellMesh& mesh) {
        std::vector<char> fixed(static_cast<std::size_t>(mesh.node_count()));
        for (int i = 0; i < mesh.node_count(); ++i)
            fixed[static_cast<std::size_t>(i)] = mesh.material_coordinates()(i, 2) > 1 - 1e-9;
        return fixed;
    }
    CellPreconditioner preconditioner(const CellPreconditionerOptions& options = {}) const {
        return {system, solid, kStep, options};
    }
};

Hanging thesis(int nodes, double psi) {
    return Hanging(cell_body(cell_solids::thesis_cube(nodes, psi, 0.1)));
}

Points random_loads(const Hanging& body, unsigned seed) {
    Points b = cell_solids::jolted(Points::Zero(body.system.size(), 3), 1.0, seed);
    for (int i = 0; i < b.rows(); ++i)
        if (body.system.fixed()[static_cast<std::size_t>(i)]) b.row(i).setZero();
    return b;
}

/// Minimum and maximum eigenvalue of B H. B is applied to every unit load; H is that of Newton's method.
std::pair<double, double> eigenvalues(const Hanging& body, const Points& x,
                                      const CellPreconditionerOptions& options = {}) {
    CellPreconditioner preconditioner = body.preconditioner(options);
    const solve::ImplicitStep step{kStep, kStep, x};
    preconditioner.refresh(step, x);
    std::vector<int> free;
    for (int i = 0; i < 3 * body.system.size(); ++i)
        if (!body.system.fixed()[static_cast<std::size_t>(i / 3)]) free.push_back(i);
    solve::HessianBuilder builder(body.system.size(), body.system.fixed());
    body.system.add_hessian(step, x, solve::Curvature::kPositive, builder);
    for (int i = 0; i < body.system.size(); ++i)
        builder.add_diagonal(i, body.system.mass_kg()[i] / (kStep * kStep));
    const Eigen::SparseMatrix<double> symmetric = builder.build().selfadjointView<Eigen::Lower>();
    const Eigen::MatrixXd whole(symmetric);
    const Eigen::MatrixXd H = whole(free, free);
    Eigen::MatrixXd B(H.rows(), H.cols());
    Points load = Points::Zero(x.rows(), 3), answer;
    for (std::size_t c = 0; c < free.size(); ++c) {
        load.data()[free[c]] = 1;
        preconditioner.apply(load, answer);
        load.data()[free[c]] = 0;
        for (std::size_t r = 0; r < free.size(); ++r)
            B(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = answer.data()[free[r]];
    }
    EXPECT_LT((B - B.transpose()).norm(), 1e-5 * B.norm());
    const Eigen::MatrixXd L = H.llt().matrixL();
    const Eigen::MatrixXd both = L.transpose() * B * L;
    const Eigen::VectorXd w = symmetric_eigenvalues(both);
    return {w.minCoeff(), w.maxCoeff()};
}

TEST(CellPreconditioner, IsNearTheInverseHoweverStiffTheVolume) {
    for (const double psi : {10.0, 100.0, 1000.0}) {
        const Hanging body = thesis(5, psi);
        const auto [min, max] = eigenvalues(body, body.solid->body().rest);
        EXPECT_GT(min, 0.4) << psi;
        EXPECT_LT(max, 2.0) << psi;
    }
}

TEST(CellPreconditioner, IsNearTheInverseOfWhatIsStretchedAndTurned) {
    const Hanging body = thesis(5, 100);
    Points x = cell_solids::jolted(body.solid->body().rest, 0.05, 3);
    x.col(2) *= 1.2;
    const Eigen::AngleAxisd turn(1.0, Vec3(1, 2, 2) / 3);
    x = (x * turn.toRotationMatrix().transpose()).eval();
    const auto [min, max] = eigenvalues(body, x);
    EXPECT_GT(min, 0.25);
    EXPECT_LT(max, 3.0);
}

TEST(CellPreconditioner, IsNearTheInverseOnGridsThatDoNotHalve) {
    const GridShape grid{4, 7, 6};
    CellModuli tissue;
    tissue.mu_pa = 30;
    tissue.bulk_pa = 3e4;
    tissue.viscosity_pa_s = 0.3;
    const Hanging body(cell_body(
        uniform_cells(grid),
        [](const Vec3& a) { return Vec3(0.03 * a[0], 0.05 * a[1], 0.04 * a[2]); }, tissue, 1000));
    const auto [min, max] = eigenvalues(body, body.solid->body().rest, {.coarsest_cells = 8});
    EXPECT_GT(min, 0.2);
    EXPECT_LT(max, 3.0);
}

TEST(CellPreconditioner, ManyLevelsAreAsGoodAsADirectSolution) {
    const Hanging body = thesis(6, 100);
    const Points& rest = body.solid->body().rest;
    const auto [min, max] = eigenvalues(body, rest, {.coarsest_cells = 1});
    const auto [direct_least, direct_most] = eigenvalues(body, rest, {.coarsest_cells = 1000});
    EXPECT_EQ(body.preconditioner({.coarsest_cells = 1}).level_count(), 4);
    EXPECT_EQ(body.preconditioner({.coarsest_cells = 1000}).level_count(), 1);
    EXPECT_LT(max / min, 2 * direct_most / direct_least);
}

TEST(CellPreconditioner, HeldNodesStayAndScaleDoesNotMatter) {
    const Hanging body = thesis(5, 100);
    CellPreconditioner preconditioner = body.preconditioner();
    const Points& rest = body.solid->body().rest;
    preconditioner.refresh({kStep, kStep, rest}, rest);
    const Points b = random_loads(body, 8);
    Points x, small, none;
    preconditioner.apply(b, x);
    preconditioner.apply(0x1p-300 * b, small);
    EXPECT_EQ(Points(0x1p300 * small), x);
    preconditioner.apply(0 * b, none);
    EXPECT_EQ(none, Points(0 * b));
    for (int i = 0; i < x.rows(); ++i)
        if (body.system.fixed()[static_cast<std::size_t>(i)])
            EXPECT_EQ(x.row(i).norm(), 0);
        else
            EXPECT_GT(x.row(i).norm(), 0);
}

TEST(CellPreconditioner, WithoutStiffnessOfVolumeEveryNodeIsOnItsOwn) {
    const Hanging body = thesis(4, 0);
    CellPreconditioner preconditioner = body.preconditioner();
    const Points& rest = body.solid->body().rest;
    preconditioner.refresh({kStep, kStep, rest}, rest);
    const Points b = random_loads(body, 9);
    Points x;
    preconditioner.apply(b, x);
    for (int i = 0; i < x.rows(); ++i)
        EXPECT_NEAR(x.row(i).dot(b.row(i)), x.row(i).norm() * b.row(i).norm(),
                    1e-5 * x.row(i).norm());
}

// The benchmark uses this number of iterations on 13^3 nodes.
TEST(CellPreconditioner, ThreeIterationsAreWithinOnePercentOfNewtonsMethod) {
    const Hanging body = thesis(6, 100);
    solve::RealTimeStep fast(body.system,
                             std::make_shared<CellPreconditioner>(body.system, body.solid, kStep),
                             {.step_s = kStep, .iterations = 3, .length_scale_m = 3});
    const auto newton = solve::make_integrator({.method = solve::Method::kImplicitEuler,
                                                .step_s = kStep,
                                                .length_scale_m = 3,
                                                .newton_tolerance = 1e-9});
    solve::MotionState state{0, body.solid->body().rest, 0 * body.solid->body().rest};
    for (int step = 0; step < 40; ++step) {
        const solve::MotionState before = state;
        fast.advance(state);
        if (step < 10 || step % 6) continue;
        solve::MotionState exact = before;
        newton->advance(body.system, exact, exact.t_s + kStep);
        EXPECT_LT((state.x - exact.x).norm(), 0.01 * (exact.x - before.x).norm()) << step;
    }
}

TEST(CellPreconditioner, TwoRunsGiveTheSameBits) {
    Points x[2];
    for (Points& at : x) {
        const Hanging body = thesis(6, 100);
        solve::RealTimeStep stepper(
            body.system, std::make_shared<CellPreconditioner>(body.system, body.solid, kStep),
            {.step_s = kStep, .iterations = 3, .length_scale_m = 3});
        solve::MotionState state{0, body.solid->body().rest, 0 * body.solid->body().rest};
        for (int step = 0; step < 10; ++step) stepper.advance(state);
        at = state.x;
    }
    EXPECT_EQ(x[0], x[1]);
}

TEST(CellPreconditioner, RefinedCellsAreRefused) {
    const Hanging body(cell_body(cell_solids::thesis_cube(4, 100), cell_solids::refined_mesh(),
                                 MassFractions::kCells));
    try {
        body.preconditioner();
        ADD_FAILURE() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "CellPreconditioner: the cells are not a uniform grid");
    }
}

}  // namespace
}  // namespace risorius::tissue
