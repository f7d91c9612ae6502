// SPDX-License-Identifier: MIT
#include "risorius/tissue/tet_solid.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tissue/layered_block.h"

namespace risorius::tissue {
namespace {

// 5 x 4 x 3 nodes: 144 tets. Another block of 3 x 2 x 2 nodes has 12, and a single tet leaves three lanes of a group empty.
const LayeredBlock kTetBlock(5, 4, 3);

Eigen::VectorXd moduli(int count, double from, double to) {
    return Eigen::VectorXd::LinSpaced(count, from, to);
}

TetSolid tissue_of(const LayeredBlock& block) {
    const int count = static_cast<int>(block.tets.rows());
    return TetSolid(block.tets, block.rest, moduli(count, 1e3, 3e3), moduli(count, 3e4, 2e4));
}

TetSolid lone_tet(Points* rest) {
    rest->resize(4, 3);
    *rest << 0, 0, 0, 3e-3, 0, 0, 1e-3, 4e-3, 0, 0, 1e-3, 2e-3;
    Tets tets(1, 4);
    tets << 0, 1, 2, 3;
    return TetSolid(tets, *rest, moduli(1, 2e3, 2e3), moduli(1, 3e4, 3e4));
}

TEST(TetSolid, RestIsFreeOfStress) {
    const TetSolid solid = tissue_of(kTetBlock);
    Points gradient = Points::Zero(kTetBlock.nodes(), 3);
    const double energy = solid.add_energy(kTetBlock.rest, gradient);
    // Strains of rounding size, squared: K V eps^2 is about 1e-33 J.
    EXPECT_LT(std::abs(energy), 1e-30);
    // K V / edge is about 0.1 N, times 1e-16 of strain.
    EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-14);
}

TEST(TetSolid, FloatForcesAreThoseOfDoubleToAMillionthAndRestIsExact) {
    const TetSolid solid = tissue_of(kTetBlock);
    const Points x = shaken(kTetBlock.rest, 8e-4, 7);
    Points exact = Points::Zero(kTetBlock.nodes(), 3), single = exact, at_rest = exact;
    const double energy = solid.add_energy(x, exact);
    EXPECT_NEAR(solid.add_energy(x, single, solve::Precision::kSingle), energy, 1e-6 * energy);
    EXPECT_LT((single - exact).norm(), 1e-6 * exact.norm());
    EXPECT_GT((single - exact).norm(), 0.0);
    EXPECT_EQ(solid.add_energy(kTetBlock.rest, at_rest, solve::Precision::kSingle), 0.0);
    EXPECT_TRUE(at_rest.isZero(0.0));
}

TEST(TetSolid, ForcesAreTheSlopeOfTheEnergy) {
    expect_gradient_is_exact(tissue_of(kTetBlock), shaken(kTetBlock.rest, 8e-4, 1));
}

TEST(TetSolid, ALoneTetWorksThoughThreeLanesAreEmpty) {
    Points rest;
    const TetSolid solid = lone_tet(&rest);
    expect_gradient_is_exact(solid, shaken(rest, 8e-4, 2));
    EXPECT_NEAR(solid.volume(rest), 3e-3 * 4e-3 * 2e-3 / 6, 1e-20);
}

TEST(TetSolid, EnergyIsThatOfTheFormulaWrittenOut) {
    Points rest;
    const TetSolid solid = lone_tet(&rest);
    const Points x = shaken(rest, 8e-4, 3);
    Mat3 d, d0;
    for (int k = 0; k < 3; ++k) {
        d.col(k) = (x.row(k + 1) - x.row(0)).transpose();
        d0.col(k) = (rest.row(k + 1) - rest.row(0)).transpose();
    }
    const Mat3 f = d * d0.inverse();
    const double volume = d0.determinant() / 6;
    const double expected =
        volume * (2e3 / 4 * (f.transpose() * f - Mat3::Identity()).squaredNorm() +
                  3e4 / 2 * std::pow(f.determinant() - 1, 2));
    Points gradient = Points::Zero(4, 3);
    EXPECT_NEAR(solid.add_energy(x, gradient), expected, 1e-12 * expected);
}

// A prism that is cut into three tets around the edge 0-1, and the same tets as solids of their own.
TEST(TetSolid, TheTetsOfAPrismKeepTheirVolumeTogether) {
    Points rest(6, 3);
    rest << 0, 0, 0, 3e-3, 0, 4e-3, 3e-3, 0, 0, 0, 4e-3, 0, 0, 4e-3, 4e-3, 0, 0, 4e-3;
    Tets tets(3, 4);
    tets << 0, 1, 2, 3, 0, 1, 3, 4, 0, 1, 4, 5;
    Eigen::VectorXd mu = moduli(3, 1e-6, 1e-6), bulk = moduli(3, 2e4, 4e4);
    const Points x = shaken(rest, 4e-4, 9);
    double weights = 0, mean = 0, apart = 0;
    for (int t = 0; t < 3; ++t) {
        const Tets one = tets.row(t);
        const TetSolid solid(one, rest, mu.segment(t, 1), bulk.segment(t, 1));
        Points gradient = Points::Zero(6, 3);
        apart += solid.add_energy(x, gradient);
        const double weight = solid.volume(rest) * bulk[t];
        weights += weight;
        mean += weight * solid.volume(x) / solid.volume(rest);
    }
    mean /= weights;
    Points gradient = Points::Zero(6, 3);
    const TetSolid together(tets, rest, mu, bulk);
    const double energy = together.add_energy(x, gradient);
    const double together_only = 0.5 * weights * std::pow(mean - 1, 2);
    EXPECT_LT(together_only, 0.5 * apart);
    const double own = TetSolid::kOwnVolume;
    EXPECT_NEAR(energy, (1 - own) * together_only + own * apart, 1e-9 * energy);
    expect_gradient_is_exact(together, x);
}

// Twisting keeps every volume, and so should the tets of a block that is twisted: what is left is an error of the mesh. If it were that
// of single tets, nearly incompressible layers would be too stiff.
TEST(TetSolid, ATwistedBlockHasASmallPartOfTheVolumeEnergyOfItsTets) {
    const LayeredBlock& block = kTetBlock;
    Points x = block.rest;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const double angle = 60.0 * x(i, 2);  // rad per m
        const double dx = x(i, 0) - 8e-3, dy = x(i, 1) - 6e-3;
        x(i, 0) = 8e-3 + std::cos(angle) * dx - std::sin(angle) * dy;
        x(i, 1) = 6e-3 + std::sin(angle) * dx + std::cos(angle) * dy;
    }
    const int count = static_cast<int>(block.tets.rows());
    const TetSolid solid(block.tets, block.rest, moduli(count, 1e-6, 1e-6),
                         moduli(count, 3e4, 3e4));
    double apart = 0;
    for (int t = 0; t < count; ++t) {
        Points four(4, 3), moved_four(4, 3);
        for (int k = 0; k < 4; ++k) {
            four.row(k) = block.rest.row(block.tets(t, k));
            moved_four.row(k) = x.row(block.tets(t, k));
        }
        Tets one(1, 4);
        one << 0, 1, 2, 3;
        Points gradient = Points::Zero(4, 3);
        apart += TetSolid(one, four, moduli(1, 1e-6, 1e-6), moduli(1, 3e4, 3e4))
                     .add_energy(moved_four, gradient);
    }
    Points gradient = Points::Zero(block.nodes(), 3);
    EXPECT_LT(solid.add_energy(x, gradient), 0.55 * apart);
}

TEST(TetSolid, RigidMotionCostsNothing) {
    const TetSolid solid = tissue_of(kTetBlock);
    const Points x = moved(kTetBlock.rest, some_motion());
    Points gradient = Points::Zero(kTetBlock.nodes(), 3);
    EXPECT_LT(std::abs(solid.add_energy(x, gradient)), 1e-28);
    EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(TetSolid, InternalForcesAddUpToNothing) {
    const Points x = shaken(kTetBlock.rest, 8e-4, 4);
    expect_no_net_force_or_torque(x, gradient_of(tissue_of(kTetBlock), x));
}

TEST(TetSolid, TheMetricIsTheStiffnessUnderSmallShearAndMore) {
    const TetSolid solid = tissue_of(kTetBlock);
    solve::MetricBuilder builder(kTetBlock.nodes());
    solid.add_metric(builder);
    const Eigen::MatrixXd lower = builder.build({});
    const Eigen::MatrixXd metric = lower.selfadjointView<Eigen::Lower>();
    EXPECT_LT((metric * Eigen::VectorXd::Ones(kTetBlock.nodes())).cwiseAbs().maxCoeff(),
              1e-10 * metric.cwiseAbs().maxCoeff());
    // Energy of any small displacement, from the gradient: u . dE(rest + u) / 2 <= 1/2 u . A u.
    const Points u = shaken(Points::Zero(kTetBlock.nodes(), 3), 1e-9, 5);
    const Points gradient = gradient_of(solid, kTetBlock.rest + u);
    const double stored = 0.5 * (u.array() * gradient.array()).sum();
    const double bound = 0.5 * (u.array() * (metric * u).array()).sum();
    EXPECT_GT(stored, 0.05 * bound);
    EXPECT_LE(stored, bound * 1.0001);
}

TEST(TetSolid, TheLaplacianIsTheMetricWithTheShearModulusAlone) {
    const LayeredBlock block(3, 2, 2);
    const int count = static_cast<int>(block.tets.rows());
    const TetSolid solid(block.tets, block.rest, moduli(count, 2e3, 2e3), moduli(count, 6e3, 6e3));
    solve::MetricBuilder metric(block.nodes()), laplacian(block.nodes());
    solid.add_metric(metric);
    solid.add_laplacian(laplacian, 5.0);  // 2 mu + K = 5 mu
    const Eigen::MatrixXd difference =
        Eigen::MatrixXd(metric.build({})) - Eigen::MatrixXd(laplacian.build({}));
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(TetSolid, AStepIsDampedAsTheLaplacianSays) {
    const LayeredBlock block(5, 4, 2);  // some tets in fans and some alone
    const TetSolid at_rest = tissue_of(block);
    TetSolid solid = tissue_of(block);
    constexpr double kViscosity = 3.0;
    solve::MetricBuilder builder(block.nodes());
    solid.add_laplacian(builder, kViscosity);
    const Eigen::MatrixXd lower = builder.build({});
    const Eigen::MatrixXd laplacian = lower.selfadjointView<Eigen::Lower>();
    const Points start = shaken(block.rest, 8e-4, 5), x = shaken(block.rest, 8e-4, 6);
    const Points damping = laplacian * (x - start);
    Points still = Points::Zero(block.nodes(), 3);
    const double energy = at_rest.add_energy(x, still);
    const double lost = 0.5 * damping.cwiseProduct(x - start).sum();
    for (const auto precision : {solve::Precision::kDouble, solve::Precision::kSingle}) {
        const double fraction = precision == solve::Precision::kDouble ? 1e-12 : 1e-6;
        solid.begin_step(start, kViscosity, precision);
        Points gradient = Points::Zero(block.nodes(), 3);
        EXPECT_NEAR(solid.add_step_energy(x, gradient, precision), energy + lost,
                    fraction * (energy + lost));
        EXPECT_LT((gradient - still - damping).norm(), fraction * damping.norm());
        // At the start of the step there is no damping.
        Points begun = Points::Zero(block.nodes(), 3), plain = begun;
        solid.add_step_energy(start, begun, precision);
        at_rest.add_energy(start, plain, precision);
        EXPECT_LT((begun - plain).norm(), fraction * plain.norm());
        // Outside of a step there is none either.
        Points outside = Points::Zero(block.nodes(), 3);
        solid.add_energy(x, outside);
        EXPECT_EQ(outside, still);
    }
}

TEST(TetSolid, SqueezingThroughItselfIsCountedAsInverted) {
    Points rest;
    const TetSolid solid = lone_tet(&rest);
    Points x = rest;
    x.col(2) *= -0.5;
    EXPECT_EQ(solid.inverted_count(rest), 0);
    EXPECT_EQ(solid.inverted_count(x), 1);
    EXPECT_NEAR(solid.min_relative_volume(x), -0.5, 1e-12);
    // The mirrored tet is not a second rest shape.
    Points mirrored = rest, gradient = Points::Zero(4, 3);
    mirrored.col(2) *= -1;
    EXPECT_NEAR(solid.add_energy(mirrored, gradient), 4e-9 * 3e4 / 2 * (4 + 4 * 1.3 * 1.3), 1e-12);
}

TEST(TetSolid, HardensOnceItHasLessThanAThirdOfItsVolume) {
    Points rest;
    const TetSolid solid = lone_tet(&rest);
    const auto energy_at = [&](double height) {
        Points x = rest, gradient = Points::Zero(4, 3);
        x.col(2) *= height;
        return solid.add_energy(x, gradient);
    };
    const auto stiffness_at = [&](double height) {
        const double step = 1e-3;
        return (energy_at(height + step) - 2 * energy_at(height) + energy_at(height - step)) /
               (step * step);
    };
    constexpr double kBulk_j = 4e-9 * 3e4;
    EXPECT_NEAR(stiffness_at(0.29) - stiffness_at(0.31), 4 * kBulk_j, 0.02 * 4 * kBulk_j);
    EXPECT_NEAR(energy_at(0.3 + 1e-7), energy_at(0.3 - 1e-7), 1e-6 * kBulk_j) << "without a jump";
}

// The traction of the stress on the faces of a tet is the force of its energy on its corners: f_k = -sigma n A / 3, summed over the
// three faces at corner k, which is sigma times the face opposite to it over 3.
TEST(TetSolid, CauchyStressGivesTheForcesOfTheEnergy) {
    for (const double amplitude : {2e-4, 8e-4, 2e-3}) {
        Points rest;
        const TetSolid solid = lone_tet(&rest);
        const Points x = shaken(rest, amplitude, 5);
        Points gradient = Points::Zero(4, 3);
        solid.add_energy(x, gradient);
        const Mat3 stress = solid.cauchy_stress_pa(x, 0);
        EXPECT_LT((stress - stress.transpose()).norm(), 1e-12 * stress.norm());
        const int opposite[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
        const double side = solid.deformation_gradient(x, 0).determinant() > 0 ? 1 : -1;
        for (int k = 0; k < 4; ++k) {
            const Vec3 a = x.row(opposite[k][0]), b = x.row(opposite[k][1]),
                       c = x.row(opposite[k][2]);
            const Vec3 area = side * 0.5 * (b - a).cross(c - a);  // outward
            const Vec3 force = stress * area / 3;
            EXPECT_LT((gradient.row(k).transpose() + force).norm(), 1e-9 * gradient.norm())
                << amplitude << " " << k;
        }
    }
}

TEST(TetSolid, MassIsDensityTimesVolume) {
    const TetSolid solid = tissue_of(kTetBlock);
    const double volume = solid.volume(kTetBlock.rest);
    EXPECT_NEAR(volume, 16e-3 * 12e-3 * 8e-3, 0.05 * volume);
    EXPECT_NEAR(solid.lumped_mass(1000.0, kTetBlock.nodes()).sum(), 1000.0 * volume, 1e-15);
}

TEST(TetSolid, TwoRunsGiveTheSameBits) {
    const TetSolid solid = tissue_of(kTetBlock), other = tissue_of(kTetBlock);
    const Points x = shaken(kTetBlock.rest, 8e-4, 6);
    Points a = Points::Zero(kTetBlock.nodes(), 3), b = a;
    other.add_energy(kTetBlock.rest, b);  // scratch data of another state must not matter
    b.setZero();
    EXPECT_EQ(solid.add_energy(x, a), other.add_energy(x, b));
    EXPECT_TRUE((a.array() == b.array()).all());
}

TEST(TetSolid, AFlatTetIsRefused) {
    Points rest(4, 3);
    rest << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
    Tets tets(1, 4);
    tets << 0, 1, 2, 3;
    try {
        TetSolid(tets, rest, moduli(1, 1, 1), moduli(1, 1, 1));
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "TetSolid: tet 0 has no positive volume at rest");
    }
}

}  // namespace
}  // namespace risorius::tissue
