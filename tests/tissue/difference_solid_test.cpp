// SPDX-License-Identifier: MIT
#include "risorius/tissue/difference_solid.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "force_term_checks.h"
#include "risorius/core/dense_algebra.h"
#include "risorius/solve/metric_builder.h"
#include "risorius/tissue/grid_shape.h"
#include "second_derivative_checks.h"

namespace risorius::tissue {
namespace {

using namespace testing_of;

using solve::Curvature;
using solve::ImplicitStep;

constexpr double kForever = std::numeric_limits<double>::infinity();

/// `tolerance` is relative to the maximum force.
void expect_free_of_net_force_and_torque(const Points& x, const Points& force, double tolerance) {
    const double largest = force.cwiseAbs().maxCoeff();
    ASSERT_GT(largest, 0.0);
    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const Vec3 p = x.row(i).transpose(), f = force.row(i).transpose();
        sum += f;
        torque += p.cross(f);
    }
    EXPECT_LT(sum.norm(), tolerance * largest);
    EXPECT_LT(torque.norm(), tolerance * largest * x.rowwise().norm().maxCoeff());
}

/// 4 x 3 x 5 nodes: a different number along every axis, and rows that are no multiple of the four lanes. Every node has its
/// own 21 numbers. The rest shape is a bent and twisted block.
GridSolid bent_solid(Parameters parameters = Parameters::kPerNode) {
    GridSolid solid;
    solid.grid = {4, 3, 5};
    solid.parameters = parameters;
    solid.rest = block_rest(solid.grid, Vec3(1.2, 0.8, 1.5));
    for (Eigen::Index i = 0; i < solid.rest.rows(); ++i) {
        const Eigen::RowVector3d p = solid.rest.row(i);
        solid.rest(i, 0) = p.x() + 0.2 * p.z() * p.z();
        solid.rest(i, 1) = p.y() + 0.15 * p.x() * p.z();
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(0.5, 2.0);
    for (int node = 0; node < solid.grid.size(); ++node) {
        SolidMaterial material;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j <= i; ++j) {
                material.elastic_n_per_m3(i, j) = material.elastic_n_per_m3(j, i) = number(random);
                material.damping_ns_per_m3(i, j) = material.damping_ns_per_m3(j, i) =
                    0.1 * number(random);
            }
        material.incompressibility_n_per_m5 = 10 * number(random);
        material.mass_kg = number(random);
        material.drag_ns_per_m = number(random);
        solid.material.push_back(material);
    }
    return solid;
}

Points shaken_rest(const GridSolid& solid, double amplitude, unsigned seed) {
    return solid.rest + random_points(solid.rest.rows(), amplitude, seed);
}

/// The thesis' operators and formulas as printed, over fields of vectors.
class PrintedFormulas {
  public:
    using Field = std::vector<Vec3>;

    explicit PrintedFormulas(const GridSolid& solid) : solid_(solid) {
        for (Eigen::Index i = 0; i < solid.rest.rows(); ++i) rest_.push_back(solid.rest.row(i));
    }

    /// - (e(r) + d(v) + k(r))
    Points force(const Points& x, const Points& velocity) const {
        Field r, v;
        for (Eigen::Index i = 0; i < x.rows(); ++i) {
            r.push_back(x.row(i));
            v.push_back(velocity.row(i));
        }
        const std::array<Field, 3> d = forward(r), dv = forward(v), d0 = forward(rest_);
        const std::size_t nodes = r.size();
        Field sum(nodes, Vec3::Zero());
        for (int i = 0; i < 3; ++i) {
            Field inner(nodes, Vec3::Zero());
            for (std::size_t n = 0; n < nodes; ++n)
                for (int j = 0; j < 3; ++j) {
                    const double metric = d[i][n].dot(d[j][n]), metric0 = d0[i][n].dot(d0[j][n]);
                    const double rate = dv[i][n].dot(d[j][n]) + d[i][n].dot(dv[j][n]);
                    const SolidMaterial& m = solid_.material[n];
                    const double alpha = m.elastic_n_per_m3(i, j) * (metric - metric0);  // (3)
                    const double gamma = m.damping_ns_per_m3(i, j) * rate;               // (6)
                    inner[n] += (alpha + gamma) * d[j][n];
                }
            subtract(backward(i, inner), -1, &sum);
        }
        // (8) with the sign of its middle term as printed: t_2 holds r_1 x r_3.
        std::array<Field, 3> t{Field(nodes), Field(nodes), Field(nodes)};
        for (std::size_t n = 0; n < nodes; ++n) {
            const auto element = [n](const std::array<Field, 3>& a) {
                return a[0][n].dot(a[1][n].cross(a[2][n]));
            };
            const double q = 2 * solid_.material[n].incompressibility_n_per_m5 *
                             (element(d) - element(d0)) * (all_forward(n) ? 1 : 0);
            t[0][n] = q * d[1][n].cross(d[2][n]);
            t[1][n] = q * d[0][n].cross(d[2][n]);
            t[2][n] = q * d[0][n].cross(d[1][n]);
        }
        subtract(backward(0, t[0]), -1, &sum);
        subtract(backward(1, t[1]), +1, &sum);
        subtract(backward(2, t[2]), -1, &sum);

        Points result(x.rows(), 3);
        for (std::size_t n = 0; n < nodes; ++n) result.row(static_cast<Eigen::Index>(n)) = sum[n];
        return result;
    }

  private:
    std::array<int, 3> at(std::size_t n) const {
        const int i = static_cast<int>(n), o = solid_.grid.o, no = solid_.grid.n * o;
        return {i / no, i / o % solid_.grid.n, i % o};
    }
    bool all_forward(std::size_t n) const {
        const auto a = at(n);
        return a[0] + 1 < solid_.grid.m && a[1] + 1 < solid_.grid.n && a[2] + 1 < solid_.grid.o;
    }
    std::array<Field, 3> forward(const Field& f) const {
        std::array<Field, 3> d;
        for (int axis = 0; axis < 3; ++axis)
            for (std::size_t n = 0; n < f.size(); ++n) {
                auto a = at(n);
                if (++a[axis] == solid_.grid.along(axis))
                    d[axis].push_back(Vec3::Zero());
                else
                    d[axis].push_back((f[index(a)] - f[n]) / solid_.grid.spacing(axis));
            }
        return d;
    }
    Field backward(int axis, const Field& f) const {
        Field d;
        for (std::size_t n = 0; n < f.size(); ++n) {
            auto a = at(n);
            const Vec3 before = --a[axis] < 0 ? Vec3::Zero() : f[index(a)];
            d.push_back((f[n] - before) / solid_.grid.spacing(axis));
        }
        return d;
    }
    std::size_t index(const std::array<int, 3>& a) const {
        return static_cast<std::size_t>(solid_.grid.index(a[0], a[1], a[2]));
    }
    /// sum -= sign * f, because the formulas give the opposite of the force.
    static void subtract(const Field& f, double sign, Field* sum) {
        for (std::size_t n = 0; n < f.size(); ++n) (*sum)[n] -= sign * f[n];
    }

    GridSolid solid_;
    Field rest_;
};

TEST(DifferenceSolid, RestOfAnyShapeIsExactlyFreeOfForceAndEnergy) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid term(solid);
    const Points still = Points::Zero(solid.rest.rows(), 3);
    EXPECT_EQ(term.energy(0, solid.rest), 0.0);
    EXPECT_EQ(force_of(term, solid.rest, still).cwiseAbs().maxCoeff(), 0.0);
}

TEST(DifferenceSolid, ForceIsTheSlopeOfTheEnergy) {
    // Acceptance T1. A step of 1e-4 m on a body of 1 m: truncation and rounding are near 1e-9.
    const GridSolid solid = bent_solid();
    expect_force_is_minus_slope_of_energy(DifferenceSolid(solid), 0, shaken_rest(solid, 0.1, 1),
                                          1e-5, 1e-8);
}

TEST(DifferenceSolid, ForceIsThatOfThePrintedFormulas) {
    // Acceptance T2: (3), (6) and (8) from the thesis' operators, coded separately.
    const GridSolid solid = bent_solid();
    const Points x = shaken_rest(solid, 0.3, 2), v = random_points(x.rows(), 2.0, 3);
    const Points printed = PrintedFormulas(solid).force(x, v);
    const Points force = force_of(DifferenceSolid(solid), x, v);
    EXPECT_LT((force - printed).cwiseAbs().maxCoeff(), 1e-12 * printed.cwiseAbs().maxCoeff());
}

TEST(DifferenceSolid, InternalForcesNeitherPushNorTurnTheBody) {
    // Acceptance T3, with damping and a large deformation.
    const GridSolid solid = bent_solid();
    const Points x = shaken_rest(solid, 0.3, 4), v = random_points(x.rows(), 2.0, 5);
    expect_free_of_net_force_and_torque(x, force_of(DifferenceSolid(solid), x, v), 1e-11);
}

TEST(DifferenceSolid, DampingOnlyTakesEnergyAway) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid term(solid);
    const Points x = shaken_rest(solid, 0.3, 6), still = Points::Zero(x.rows(), 3);
    for (unsigned seed = 10; seed < 20; ++seed) {
        const Points v = random_points(x.rows(), 2.0, seed);
        const Points damping = force_of(term, x, v) - force_of(term, x, still);
        EXPECT_LT(damping.cwiseProduct(v).sum(), 0.0);
    }
}

TEST(DifferenceSolid, RigidMotionMeetsNoForce) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid term(solid);
    Rigid motion = Rigid::Identity();
    motion.rotate(Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()));
    motion.pretranslate(Vec3(3, -1, 2));
    Points x(solid.rest.rows(), 3), v(solid.rest.rows(), 3);
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        x.row(i) = (motion * Vec3(solid.rest.row(i).transpose())).transpose();
        v.row(i) = Vec3(0.3, -2, 1).cross(Vec3(x.row(i).transpose())).transpose();
    }
    const double typical = force_of(term, shaken_rest(solid, 0.1, 1), v).cwiseAbs().maxCoeff();
    EXPECT_LT(force_of(term, x, v).cwiseAbs().maxCoeff(), 1e-12 * typical);
}

TEST(DifferenceSolid, PotentialWithoutMotionIsTheEnergyAndItsGradientTheForce) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid term(solid);
    const Points x = shaken_rest(solid, 0.2, 8), still = Points::Zero(x.rows(), 3);
    Points gradient = still;
    const double potential =
        term.add_potential({.end_s = 0, .step_s = kForever, .start = solid.rest}, x, gradient);
    EXPECT_EQ(potential, term.energy(0, x));
    EXPECT_EQ((gradient + force_of(term, x, still)).cwiseAbs().maxCoeff(), 0.0);
}

TEST(DifferenceSolid, GradientOfAStepIsTheSlopeOfItsPotential) {
    const GridSolid solid = bent_solid();
    const Points start = shaken_rest(solid, 0.1, 9),
                 x = start + random_points(start.rows(), 0.1, 10);
    expect_gradient_of_potential(DifferenceSolid(solid),
                                 {.end_s = 0, .step_s = 0.02, .start = start}, x, 1e-5, 1e-8);
}

TEST(DifferenceSolid, GradientOfASmallStepTendsToForceWithDamping) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid term(solid);
    const Points x = shaken_rest(solid, 0.1, 11), v = random_points(x.rows(), 1.0, 12);
    const Points force = force_of(term, x, v);
    double previous = kForever;
    for (const double h : {1e-2, 1e-3, 1e-4}) {
        const Points start = x - h * v;
        const double error =
            (potential_gradient(term, {.end_s = 0, .step_s = h, .start = start}, x) + force)
                .cwiseAbs()
                .maxCoeff() /
            force.cwiseAbs().maxCoeff();
        EXPECT_LT(error, 0.15 * previous);  // first order in h
        previous = error;
    }
    EXPECT_LT(previous, 1e-3);
}

TEST(DifferenceSolid, SecondDerivativeIsExact) {
    const GridSolid solid = bent_solid();
    const Points start = shaken_rest(solid, 0.1, 13),
                 x = start + random_points(start.rows(), 0.1, 14);
    const DifferenceSolid term(solid);
    for (const double step : {0.02, kForever})
        expect_hessian_of_potential(term, {.end_s = 0, .step_s = step, .start = start}, x, 1e-5,
                                    1e-8);
}

TEST(DifferenceSolid, PositivePartIsPositiveWhereTheSecondDerivativeIsNot) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid term(solid);
    // Compressed to a third, so that all stresses are compressive.
    const Points x = 0.33 * shaken_rest(solid, 0.1, 15);
    const ImplicitStep step{.end_s = 0, .step_s = kForever, .start = solid.rest};
    const auto min = [&](Curvature curvature) {
        const Eigen::VectorXd values = symmetric_eigenvalues(hessian(term, step, x, curvature));
        return values[0] / values[values.size() - 1];
    };
    EXPECT_LT(min(Curvature::kExact), -1e-3);
    EXPECT_GT(min(Curvature::kPositive), -1e-14);
}

TEST(DifferenceSolid, PositivePartIsTheSecondDerivativeAtRest) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid term(solid);
    const ImplicitStep step{.end_s = 0, .step_s = 0.1, .start = solid.rest};
    const Eigen::MatrixXd exact = hessian(term, step, solid.rest, Curvature::kExact);
    const Eigen::MatrixXd positive = hessian(term, step, solid.rest, Curvature::kPositive);
    EXPECT_LT((exact - positive).cwiseAbs().maxCoeff(), 1e-14 * exact.cwiseAbs().maxCoeff());
}

TEST(DifferenceSolid, MetricBoundsTheSecondDerivativeAtRest) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid term(solid);
    for (const double step : {0.01, kForever}) {
        solve::MetricBuilder builder(solid.grid.size());
        term.add_metric(step, builder);
        const Eigen::MatrixXd scalar =
            Eigen::MatrixXd(builder.build({})).selfadjointView<Eigen::Lower>();
        Eigen::MatrixXd metric = Eigen::MatrixXd::Zero(3 * scalar.rows(), 3 * scalar.rows());
        for (Eigen::Index i = 0; i < scalar.rows(); ++i)
            for (Eigen::Index j = 0; j < scalar.rows(); ++j)
                for (int k = 0; k < 3; ++k) metric(3 * i + k, 3 * j + k) = scalar(i, j);
        const Eigen::MatrixXd stiffness = hessian(
            term, {.end_s = 0, .step_s = step, .start = solid.rest}, solid.rest, Curvature::kExact);
        // Maximum fraction of the bound that is used. The small diagonal stands for the mass that holds the body in place.
        metric.diagonal().array() += 1e-9 * metric.diagonal().maxCoeff();
        const double used = testing_of::fractions(stiffness, metric).maxCoeff();
        EXPECT_LT(used, 1.0 + 1e-9);
        EXPECT_GT(used, 0.5);  // a much larger bound would cost as many times the iterations
    }
}

TEST(DifferenceSolid, SecantMatrixGivesTheForceBack) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid term(solid);
    const Points x = shaken_rest(solid, 0.2, 16), v = random_points(x.rows(), 1.0, 17);
    const Points force = force_of(term, x, v);
    for (const bool lag_rate : {false, true}) {
        solve::MetricBuilder K(solid.grid.size()), damping(solid.grid.size());
        Points rest_of_it = Points::Zero(x.rows(), 3);
        term.add_secant(0, x, v, lag_rate, K, damping, rest_of_it);
        const Eigen::MatrixXd matrix = Eigen::MatrixXd(K.build({})).selfadjointView<Eigen::Lower>();
        EXPECT_LT((rest_of_it - matrix * x - force).cwiseAbs().maxCoeff(),
                  1e-12 * force.cwiseAbs().maxCoeff());
        EXPECT_EQ(damping.build({}).nonZeros(), 0);
    }
}

TEST(DifferenceSolid, SameInputGivesTheSameBits) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid one(solid), other(solid);
    const Points x = shaken_rest(solid, 0.2, 18), v = random_points(x.rows(), 1.0, 19);
    const Points first = force_of(one, x, v);
    one.energy(0, solid.rest);  // another evaluation in between
    EXPECT_EQ(first, force_of(one, x, v));
    EXPECT_EQ(first, force_of(other, x, v));
    EXPECT_EQ(one.energy(0, x), other.energy(0, x));
}

TEST(DifferenceSolid, VolumeElementsAreSigned) {
    const GridSolid solid = bent_solid();
    const DifferenceSolid term(solid);
    Points mirrored = solid.rest;
    mirrored.col(0) *= -1;
    EXPECT_GT(term.volume_element_sum(solid.rest), 0.0);
    EXPECT_DOUBLE_EQ(term.volume_element_sum(mirrored), -term.volume_element_sum(solid.rest));
    EXPECT_EQ(term.inverted_count(solid.rest), 0);
    EXPECT_EQ(term.inverted_count(mirrored), 3 * 2 * 4);
    // With |dV| the mirrored body would be free of stress.
    EXPECT_GT(term.energy(0, mirrored), 1.0);
}

TEST(DifferenceSolid, ResolutionIndependentParametersGiveABlockTheSameEnergyPerStretch) {
    // (1/4) lambda_33 (G_33 - G0_33)^2 for a stretch along a3, for any grid.
    for (const GridShape grid : {GridShape{3, 3, 3}, GridShape{4, 2, 7}, GridShape{6, 5, 4}}) {
        GridSolid solid{grid, block_rest(grid, Vec3(1, 2, 3)), {}};
        solid.material = {isotropic_material(1.5, 0, 0, 1, 0)};
        Points x = solid.rest;
        x.col(2) *= 1.2;
        const double strain = 9 * (1.2 * 1.2 - 1);
        EXPECT_NEAR(DifferenceSolid(solid).energy(0, x), 0.25 * 1.5 * strain * strain, 1e-11);
    }
}

TEST(DifferenceSolid, RefusesWhatIsNoBody) {
    GridSolid solid = bent_solid();
    solid.material[4].mass_kg = -1;
    try {
        const DifferenceSolid term(solid, "cube.json:/solid");
        FAIL() << "a negative mass was taken";
    } catch (const std::exception& error) {
        EXPECT_STREQ(error.what(),
                     "cube.json:/solid/material/4/mass_kg: expected (0, inf), found -1");
    }
}

}  // namespace
}  // namespace risorius::tissue
