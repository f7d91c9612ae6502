// SPDX-License-Identifier: MIT
// Implicit Euler, Baraff-Witkin, Terzopoulos and equilibria.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "risorius/core/dense_algebra.h"
#include "risorius/solve/integrator.h"
#include "risorius/solve/newton.h"
#include "toy_terms.h"

namespace risorius::solve {
namespace {

using toy::Anchor;
using toy::Chain;
using toy::Stiffening;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Method kImplicit[] = {Method::kTerzopoulos, Method::kBaraffWitkin,
                                Method::kImplicitEuler};

/// A horizontal chain of 8 nodes, fixed at one end, which falls and swings.
MotionSystem swing(double stiffness = 200) {
    return toy::system_of(8, 0.05, std::make_shared<Chain>(stiffness, 0.1, 0.05 * 9.81),
                          toy::first_fixed(8));
}

double incremental_potential(const MotionSystem& system, const ImplicitStep& step,
                             const Points& target, const Points& x) {
    Points gradient;
    double sum = system.potential(step, x, gradient);
    for (int i = 0; i < system.size(); ++i)
        if (!system.fixed()[static_cast<std::size_t>(i)])
            sum += 0.5 * system.mass_kg()[i] * (x.row(i) - target.row(i)).squaredNorm() /
                   (step.step_s * step.step_s);
    return sum;
}

TEST(ImplicitEuler, IsOfOrderOneAndExactForTheDifferenceEquation) {
    // (x+ - x)/h = v+, (v+ - v)/h = -w^2 x+ - d v+.
    const double w = 3, d = 0.5, m = 2, h = 0.05;
    const MotionSystem system = toy::system_of(1, m, std::make_shared<Anchor>(m * w * w, m * d));
    for (const Method method : {Method::kImplicitEuler, Method::kBaraffWitkin}) {
        MotionState state = toy::at_rest(Points::Ones(1, 3));
        make_integrator({.method = method, .step_s = h})->advance(system, state, 10 * h);
        double x = 1, v = 0;
        for (int k = 0; k < 10; ++k) {
            v = (v - h * w * w * x) / (1 + h * d + h * h * w * w);
            x += h * v;
        }
        EXPECT_NEAR(state.x(0, 1), x, 1e-13) << name_of(method);
        EXPECT_NEAR(state.v(0, 1), v, 1e-12) << name_of(method);
    }
    const auto error = [&](double step_s) {
        MotionState state = toy::at_rest(Points::Ones(1, 3));
        make_integrator({.method = Method::kImplicitEuler, .step_s = step_s})
            ->advance(system, state, 1.0);
        const double r = std::sqrt(w * w - d * d / 4);
        return std::abs(state.x(0, 0) - std::exp(-d / 2) * (std::cos(r) + d / 2 / r * std::sin(r)));
    };
    EXPECT_NEAR(std::log2(error(1.0 / 1024) / error(1.0 / 2048)), 1, 0.05);
}

TEST(ImplicitEuler, LosesEnergyAtAnyStepAndStaysBounded) {
    for (const double h : {1e-3, 1.0 / 60, 0.3, 10.0, 1e4}) {
        const MotionSystem system = swing();
        MotionState state = toy::at_rest(toy::straight(8, 0.1));
        const auto integrator = make_integrator(
            {.method = Method::kImplicitEuler, .step_s = h, .newton_iterations = 60});
        double energy = system.energy(0, state.x);
        const double scale = std::abs(energy) + 1;
        for (int k = 1; k <= 40; ++k) {
            const IntegratorReport report = integrator->advance(system, state, k * h);
            ASSERT_FALSE(report.diverged) << h;
            ASSERT_TRUE(report.converged) << h << " step " << k;
            const double now = system.energy(state.t_s, state.x) + system.kinetic_energy(state.v);
            EXPECT_LE(now, energy + 1e-12 * scale) << h << " step " << k;
            energy = now;
        }
    }
}

TEST(ImplicitEuler, NeverRaisesItsPotential) {
    const MotionSystem system = swing();
    for (const Curvature curvature : {Curvature::kExact, Curvature::kPositive}) {
        for (const double h : {0.01, 0.1, 1.0}) {
            for (int seed = 0; seed < 10; ++seed) {
                Points start = toy::straight(8, 0.1);
                for (int i = 1; i < 8; ++i)
                    for (int k = 0; k < 3; ++k)
                        start(i, k) += 0.2 * std::sin(17.0 * i + 5.0 * k + seed);
                const ImplicitStep step{h, h, start};
                Points target = start;
                Points x = start;
                const double before = incremental_potential(system, step, target, x);
                Newton newton;
                double last = before;
                for (int k = 1; k <= 12; ++k) {  // one iteration at a time
                    newton.minimise(system, step, target,
                                    {.iterations = 1, .tolerance_m = 1e-12, .curvature = curvature},
                                    x);
                    const double now = incremental_potential(system, step, target, x);
                    EXPECT_LE(now, last + 1e-12 * std::abs(before)) << h << " " << seed;
                    last = now;
                }
                EXPECT_LT(last, before);
            }
        }
    }
}

TEST(Newton, ConvergesQuadraticallyOnAStiffeningSpring) {
    // The minimum is where m (x - y)/h^2 + F sinh(x/l) = 0.
    const double m = 1, h = 0.1, y = 0.5, F = 3, l = 0.2;
    double root = 0.2;
    for (int k = 0; k < 60; ++k)
        root -= (m * (root - y) / h / h + F * std::sinh(root / l)) /
                (m / h / h + F / l * std::cosh(root / l));
    const MotionSystem system = toy::system_of(1, m, std::make_shared<Stiffening>(F, l));
    const Points start = Points::Constant(1, 3, y);
    Points x = start;
    double before = std::abs(x(0, 0) - root);
    Newton newton;
    double constant = 0;
    int quadratic = 0;
    for (int k = 0; k < 8 && before > 1e-7; ++k) {
        newton.minimise(system, {h, h, start}, start, {.iterations = 1}, x);
        const double error = std::abs(x(0, 0) - root);
        if (before < 0.05) {
            // e+ / e^2 converges to |Phi'''| / (2 Phi'').
            constant = error / (before * before);
            const double limit =
                F / l / l * std::sinh(root / l) / (2 * (m / h / h + F / l * std::cosh(root / l)));
            EXPECT_NEAR(constant / limit, 1, 0.15);
            ++quadratic;
        }
        before = error;
    }
    EXPECT_GE(quadratic, 1);
    const NewtonReport report =
        newton.minimise(system, {h, h, start}, start, {.tolerance_m = 1e-12}, x);
    EXPECT_TRUE(report.converged);
    EXPECT_NEAR(x(0, 0), root, 1e-14);
}

TEST(Newton, ConjugateGradientsFindTheSameStepAsTheFactor) {
    const MotionSystem system = swing();
    const Points start = toy::straight(8, 0.09);
    Points target = start;
    target.col(1).array() -= 0.02;
    target.row(0) = start.row(0);
    Points direct = start, iterative = start;
    Newton newton;
    const NewtonReport a = newton.minimise(system, {0.05, 0.05, start}, target,
                                           {.iterations = 60, .tolerance_m = 1e-11}, direct);
    const NewtonReport b = newton.minimise(
        system, {0.05, 0.05, start}, target,
        {.iterations = 60, .tolerance_m = 1e-11, .linear = LinearSolver::kConjugate}, iterative);
    EXPECT_TRUE(a.converged);
    EXPECT_TRUE(b.converged);
    EXPECT_LT((direct - iterative).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(BaraffWitkin, IsOneUndampedNewtonStepWithTheExactCurvature) {
    // The chain is compressed, so that its exact curvature is indefinite.
    const double m = 0.05, h = 0.2;
    const Chain chain(200, 0.1, m * 9.81);
    const MotionSystem system =
        toy::system_of(8, m, std::make_shared<Chain>(chain), toy::first_fixed(8));
    MotionState state = toy::at_rest(toy::straight(8, 0.07));
    for (int i = 1; i < 8; ++i) state.v(i, 2) = 0.1 * i;
    const Points x = state.x, v = state.v;

    HessianBuilder builder(8, toy::first_fixed(8));
    system.add_hessian({h, h, x}, x, Curvature::kExact, builder);
    Eigen::MatrixXd A = Eigen::MatrixXd(builder.build()).selfadjointView<Eigen::Lower>();
    const double min = symmetric_eigenvalues(A)[0];
    ASSERT_LT(min + m / h / h, -1) << "the case is meant to be indefinite";
    Points force;
    system.force(0, x, v, force);
    Eigen::VectorXd b(24);
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k) {
            b[3 * i + k] = i == 0 ? 0 : force(i, k) + m * v(i, k) / h;
            if (i > 0) A(3 * i + k, 3 * i + k) += m / h / h;
        }
    const Eigen::VectorXd move = solved_for(A, b);

    const IntegratorReport report =
        make_integrator({.method = Method::kBaraffWitkin, .step_s = h})->advance(system, state, h);
    EXPECT_EQ(report.linear_solves, 1);
    EXPECT_EQ(report.rejections, 0);
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(state.x(i, k) - x(i, k), move[3 * i + k], 1e-10 * move.norm());
    EXPECT_LT((state.v - (state.x - x) / h).norm(), 1e-12);
}

TEST(BaraffWitkin, WhereTheExactCurvatureIsSingularThePositiveOneIsTaken) {
    // Shortened until the transverse stiffness cancels the inertia: k (s^2 - 1) = -m/h^2 per link of one free node.
    const double m = 1, h = 0.5, k = 8, s = std::sqrt(1 - m / h / h / k);
    const MotionSystem system =
        toy::system_of(2, m, std::make_shared<Chain>(k, 1.0, 0.0), toy::first_fixed(2));
    MotionState state = toy::at_rest(toy::straight(2, s));
    const IntegratorReport report =
        make_integrator({.method = Method::kBaraffWitkin, .step_s = h})->advance(system, state, h);
    EXPECT_FALSE(report.diverged);
    EXPECT_TRUE(state.x.allFinite());
    EXPECT_GT(state.x(1, 0), s);  // pushed outwards
    EXPECT_EQ(state.x(1, 1), 0);
}

/// Maximum step with which a short chain, stretched by the fraction `strain`, keeps oscillating along itself within bounds.
double terzopoulos_limit(double strain) {
    const MotionSystem system =
        toy::system_of(2, 1.0, std::make_shared<Chain>(50.0, 1.0, 0.0), toy::first_fixed(2));
    double min = 0.01, max = 2;
    for (int halving = 0; halving < 14; ++halving) {
        const double h = std::sqrt(min * max);
        MotionState state = toy::at_rest(toy::straight(2, 1.0));
        state.v(1, 0) = strain * 10;  // w = sqrt(2 k / m) = 10
        const auto integrator = make_integrator({.method = Method::kTerzopoulos, .step_s = h});
        bool bounded = true;
        for (int k = 1; k <= 4000 && bounded; ++k) {
            bounded = !integrator->advance(system, state, k * h).diverged &&
                      std::abs(state.x(1, 0) - 1) < 100 * strain;
        }
        (bounded ? min : max) = h;
    }
    return min;
}

TEST(Terzopoulos, NearRestItIsVerletAndNoMoreStable) {
    EXPECT_NEAR(terzopoulos_limit(1e-6) * 10, 2.0, 0.05);

    // Step for step like Verlet with the force at the start of the step, to first order in the strain.
    const MotionSystem system =
        toy::system_of(2, 1.0, std::make_shared<Chain>(50.0, 1.0, 0.0), toy::first_fixed(2));
    MotionState a = toy::at_rest(toy::straight(2, 1.0)), b = a;
    a.v(1, 0) = b.v(1, 0) = 1e-5;
    make_integrator({.method = Method::kTerzopoulos, .step_s = 0.02})->advance(system, a, 1.0);
    make_integrator({.method = Method::kVerlet, .step_s = 0.02})->advance(system, b, 1.0);
    EXPECT_NEAR(a.x(1, 0) - 1, b.x(1, 0) - 1, 1e-3 * 1e-6);
}

TEST(Terzopoulos, SolvesItsEquationOfALinearSpring) {
    // For constant K and C: m (x+ - 2x + x-)/h^2 + c (x+ - x-)/2h + k x+ = f.
    const double m = 2, c = 0.6, k = 30, h = 0.03, f = 4;
    auto anchor = std::make_shared<Anchor>(k, c);
    anchor->load = [f](double) { return Vec3(f, 0, 0); };
    const MotionSystem system = toy::system_of(1, m, anchor);
    MotionState state = toy::at_rest(Points::Zero(1, 3));
    const auto integrator = make_integrator({.method = Method::kTerzopoulos, .step_s = h});
    integrator->advance(system, state, h);
    double before = 0, now = state.x(0, 0);
    for (int step = 2; step <= 30; ++step) {
        const double next =
            (f + m * (2 * now - before) / h / h + c * before / 2 / h) / (m / h / h + c / 2 / h + k);
        integrator->advance(system, state, step * h);
        EXPECT_NEAR(state.x(0, 0), next, 1e-12);
        before = now;
        now = next;
    }
}

TEST(QuasiStatic, FindsTheHangingChainOfKnownStretch) {
    // Link i carries the weight below it: k (s^2 - 1) s = T / l. The solve starts from a horizontal chain, which has no
    // transverse stiffness.
    const double k = 200, l = 0.1, weight = 0.05 * 9.81;
    for (const LinearSolver linear : {LinearSolver::kDirect, LinearSolver::kConjugate}) {
        const MotionSystem system = swing(k);
        MotionState state = toy::at_rest(toy::straight(8, l));
        state.v.setOnes();
        const IntegratorReport report = equilibrium(system, state, {.linear = linear});
        EXPECT_TRUE(report.converged);
        EXPECT_FALSE(report.diverged);
        EXPECT_EQ(state.v, Points::Zero(8, 3));
        for (int i = 0; i + 1 < 8; ++i) {
            const double tension = (7 - i) * weight;
            double s = 1;
            for (int it = 0; it < 50; ++it)
                s -= (k * l * (s * s * s - s) - tension) / (k * l * (3 * s * s - 1));
            EXPECT_NEAR(state.x(i, 1) - state.x(i + 1, 1), s * l, 1e-9) << i;
            EXPECT_NEAR(state.x(i + 1, 0), 0, 1e-7) << i;
        }
        EXPECT_LT(report.linear_solves, 100);
    }
}

TEST(QuasiStatic, FollowsItsLoadAndHoldsPrescribedNodes) {
    auto anchor = std::make_shared<Anchor>(10.0, 3.0);
    anchor->load = [](double t) { return Vec3(t, 0, 0); };
    MotionSystem system = toy::system_of(2, 1.0, anchor, toy::first_fixed(2));
    system.set_boundary_conditions([](double t_s, Points& x, Points& v) {
        x.row(0).setConstant(t_s);
        v.row(0).setOnes();
    });
    MotionState state = toy::at_rest(Points::Zero(2, 3));
    const auto integrator = make_integrator({.method = Method::kQuasiStatic});
    for (const double t : {0.0, 1.0, 2.5}) {
        const IntegratorReport report = integrator->advance(system, state, t);
        EXPECT_TRUE(report.converged);
        EXPECT_EQ(state.t_s, t);
        EXPECT_NEAR(state.x(1, 0), t / 10, 1e-12);
        EXPECT_EQ(state.x(0, 2), t);
        EXPECT_EQ(state.v, Points::Zero(2, 3));
    }
}

TEST(QuasiStatic, ABodyWithoutSupportDiverges) {
    const MotionSystem system = toy::system_of(3, 1.0, std::make_shared<Chain>(10.0, 1.0, 9.81));
    MotionState state = toy::at_rest(toy::straight(3, 1.0));
    const IntegratorReport report = equilibrium(system, state, {});
    EXPECT_TRUE(report.diverged);
    EXPECT_FALSE(report.converged);
}

TEST(ImplicitMethods, FixedAndPrescribedNodesAreWhereTheyAreTold) {
    for (const Method method : kImplicit) {
        MotionSystem system = swing();
        system.set_boundary_conditions([](double t_s, Points& x, Points& v) {
            x.row(0) << 0, 0.1 * std::sin(t_s), 0;
            v.row(0) << 0, 0.1 * std::cos(t_s), 0;
        });
        MotionState state = toy::at_rest(toy::straight(8, 0.1));
        make_integrator({.method = method, .step_s = 0.01})->advance(system, state, 0.3);
        EXPECT_EQ(state.x(0, 1), 0.1 * std::sin(0.3)) << name_of(method);
        EXPECT_EQ(state.v(0, 1), 0.1 * std::cos(0.3)) << name_of(method);
        EXPECT_TRUE(state.x.allFinite());
    }
}

TEST(ImplicitMethods, APulledNodeDragsItsNeighbourAlong) {
    // Without weight, a pull along the chain at constant speed ends as translation at that speed.
    for (const Method method : {Method::kBaraffWitkin, Method::kImplicitEuler}) {
        MotionSystem system =
            toy::system_of(3, 1.0, std::make_shared<Chain>(100.0, 1.0, 0.0), toy::first_fixed(3));
        system.set_boundary_conditions([](double t_s, Points& x, Points& v) {
            x.row(0) << -0.1 * t_s, 0, 0;
            v.row(0) << -0.1, 0, 0;
        });
        MotionState state = toy::at_rest(toy::straight(3, 1.0));
        make_integrator({.method = method, .step_s = 0.1, .newton_iterations = 50})
            ->advance(system, state, 60.0);
        EXPECT_NEAR(state.v(2, 0), -0.1, 1e-3) << name_of(method);
        EXPECT_NEAR(state.x(2, 0), -0.1 * 60 + 2, 0.01) << name_of(method);
    }
}

TEST(ImplicitMethods, AdvancingInPiecesOrAgainGivesTheSameBits) {
    for (const Method method : kImplicit) {
        const MotionSystem system = swing();
        MotionState whole = toy::at_rest(toy::straight(8, 0.1)), pieces = whole, again = whole;
        const IntegratorOptions options{.method = method, .step_s = 0.005};
        make_integrator(options)->advance(system, whole, 0.4);
        const auto integrator = make_integrator(options);
        for (int k = 1; k <= 8; ++k) integrator->advance(system, pieces, 0.05 * k);
        make_integrator(options)->advance(system, again, 0.4);
        EXPECT_EQ(whole.x, pieces.x) << name_of(method);
        EXPECT_EQ(whole.x, again.x) << name_of(method);
        EXPECT_EQ(whole.v, again.v) << name_of(method);
        EXPECT_TRUE(whole.x.allFinite()) << name_of(method);
    }
}

}  // namespace
}  // namespace risorius::solve
