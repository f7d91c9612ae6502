// SPDX-License-Identifier: MIT
// Bundles of fibres with tendon, pennation and the curves of volume muscles: the same as a chain of a volume muscle, and derivatives.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "force_term_checks.h"
#include "risorius/muscle/chain_set.h"
#include "risorius/muscle/fibre_set.h"
#include "second_derivative_checks.h"

namespace risorius::muscle {
namespace {

constexpr double kPassiveStrain = 1.5;

/// A fibre along x of four nodes, 30 mm long.
Points row_of_nodes() {
    Points x = Points::Zero(4, 3);
    x.col(0) << 0, 0.01, 0.02, 0.03;
    return x;
}

FibreSet bundle(double tendon, double pennation_rad, double rest_stretch) {
    std::vector<FibrePoint> points(4);
    for (int i = 0; i < 4; ++i) {
        points[static_cast<std::size_t>(i)].count = 1;
        points[static_cast<std::size_t>(i)].nodes[0] = i;
        points[static_cast<std::size_t>(i)].weights[0] = 1;
    }
    return {points,
            {{.first_point = 0,
              .point_count = 4,
              .f0_n = 3,
              .rest_stretch = rest_stretch,
              .max_speed_hz = 8,
              .tendon_fraction = tendon,
              .pennation_rad = pennation_rad}},
            row_of_nodes(),
            {.passive_strain = kPassiveStrain, .zajac = true}};
}

Eigen::VectorXd active(double a) { return Eigen::VectorXd::Constant(1, a); }

TEST(BundleTendons, MakeTheFibreThatOfAChainOfAVolumeMuscle) {
    for (const double tendon : {0.0, 0.06, 0.4})
        for (const double pennation : {0.0, 0.3})
            for (const double r : {1.0, 0.9}) {
                const FibreSet set = bundle(tendon, pennation, r);
                const ChainSet chain({{0, 1, 2, 3}}, row_of_nodes(),
                                     {.f0_n = 3,
                                      .rest_stretch = r,
                                      .pennation_rad = pennation,
                                      .tendon_fraction = tendon},
                                     zajac_curves({.passive_strain = kPassiveStrain}));
                for (const double a : {0.0, 0.7})
                    for (const double s : {0.75, 0.9, 1.0, 1.2}) {
                        const Points x = s * row_of_nodes();
                        Points mine = Points::Zero(4, 3), theirs = mine, none = mine;
                        const double energy = set.add_energy(x, active(a), mine),
                                     there = set.add_energy(row_of_nodes(), active(a), none);
                        EXPECT_NEAR(energy - there,
                                    chain.add_energy(x, a, theirs) -
                                        chain.add_energy(row_of_nodes(), a, none),
                                    1e-12);
                        EXPECT_NEAR(mine(3, 0), theirs(3, 0), 1e-10) << tendon << " " << s;
                        EXPECT_NEAR(set.states(x, active(a))[0].force_n,
                                    chain.states(x, a)[0].force_n, 1e-10);
                        EXPECT_NEAR(set.states(x, active(a))[0].stretch,
                                    chain.states(x, a)[0].stretch, 1e-12);
                    }
            }
}

TEST(BundleTendons, HaveDerivativesOfTheirEnergy) {
    FibreSet set = bundle(0.3, 0.25, 0.95);
    const Points x = 1.05 * row_of_nodes() + testing_of::random_points(4, 1e-3, 5);
    const auto energy = [&](const Points& y, Points& g) {
        return set.add_energy(y, active(0.6), g);
    };
    const auto second = [&](solve::Curvature curvature) {
        return testing_of::dense_second(4, [&](solve::HessianBuilder& builder) {
            set.add_hessian(x, active(0.6), curvature, builder);
        });
    };
    testing_of::expect_slope_of_gradient(second(solve::Curvature::kExact), x, energy, 1e-8, 1e-6);
    // In a step the gradient is that of the energy, and what rests there rests at rest.
    Points at_rest = Points::Zero(4, 3), gradient = at_rest, none = at_rest;
    energy(x, at_rest);
    set.begin_step(x, 0.01);
    energy(x, gradient);
    EXPECT_TRUE(gradient.isApprox(at_rest, 1e-5));
    const Points moved = x + testing_of::random_points(4, 2e-4, 6);
    gradient.setZero();
    energy(moved, gradient);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        Points up = moved, down = moved;
        up.data()[i] += 1e-8;
        down.data()[i] -= 1e-8;
        EXPECT_NEAR(gradient.data()[i], (energy(up, none) - energy(down, none)) / 2e-8, 1e-5);
    }
}

TEST(BundleTendons, ShortenTheFibreMoreThanThePath) {
    // A tenth of tendon: 9 mm less of 30 mm are 9 of 27 mm of fibre.
    const FibreSet set = bundle(0.1, 0, 1);
    EXPECT_NEAR(set.mean_stretch(0.7 * row_of_nodes())[0], 18.0 / 27, 1e-12);
    EXPECT_THROW(bundle(1, 0, 1), std::invalid_argument);
    EXPECT_THROW(bundle(0, 1.2, 0.9), std::invalid_argument);
}

}  // namespace
}  // namespace risorius::muscle
