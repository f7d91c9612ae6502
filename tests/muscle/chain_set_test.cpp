// SPDX-License-Identifier: MIT
// Chains of fibres with tendons in series.
#include "risorius/muscle/chain_set.h"

#include <gtest/gtest.h>

#include <cmath>

namespace risorius::muscle {
namespace {

/// Two chains of four segments of 10 mm along x, 5 mm apart.
struct TwoChains {
    Points rest;
    std::vector<std::vector<int>> chains{{}, {}};
    TwoChains() : rest(10, 3) {
        for (int i = 0; i < 10; ++i) {
            rest.row(i) << 0.01 * (i % 5), 0.005 * (i / 5), 0.0;
            chains[static_cast<std::size_t>(i / 5)].push_back(i);
        }
    }
    ChainSet make(const ChainProperties& properties) const {
        return ChainSet(chains, rest, properties, zajac_curves());
    }
};

const ChainProperties kMasseterLike{.f0_n = 10,
                                    .rest_stretch = 0.9,
                                    .pennation_rad = 0.24,
                                    .tendon_fraction = 0.45,
                                    .rigid_tendon = false};

TEST(ChainSet, TheGradientIsTheSlopeOfTheEnergy) {
    const TwoChains two;
    for (const bool rigid : {true, false}) {
        ChainProperties properties = kMasseterLike;
        properties.rigid_tendon = rigid;
        const ChainSet set = two.make(properties);
        Points x = two.rest;
        for (int i = 0; i < 10; ++i)
            x.row(i) +=
                2e-3 * Vec3(std::sin(3.0 * i), std::sin(5.0 * i), std::cos(7.0 * i)).transpose();
        for (const double a : {0.0, 0.3, 1.0}) {
            Points gradient = Points::Zero(10, 3), scratch = gradient;
            set.add_energy(x, a, gradient);
            const double h = 1e-7;  // central difference: the error is about 1e-8 N
            for (int i = 0; i < 10; i += 3)
                for (int k = 0; k < 3; ++k) {
                    Points there = x;
                    there(i, k) += h;
                    const double up = set.add_energy(there, a, scratch);
                    there(i, k) -= 2 * h;
                    const double down = set.add_energy(there, a, scratch);
                    EXPECT_NEAR(gradient(i, k), (up - down) / (2 * h), 1e-6)
                        << "rigid " << rigid << " a " << a << " node " << i;
                }
            EXPECT_LT(gradient.colwise().sum().norm(), 1e-12) << "forces inside add up to nothing";
        }
    }
}

TEST(ChainSet, TheStateOfAChainIsTheSlopeOfItsEnergyByItsLength) {
    const TwoChains two;
    const ChainSet set = two.make(kMasseterLike);
    Points scratch = Points::Zero(10, 3);
    const auto stretched = [&](double factor) -> Points { return factor * two.rest; };
    for (const double factor : {0.95, 1.0, 1.1}) {
        const std::vector<ChainSet::State> states = set.states(stretched(factor), 0.4);
        ASSERT_EQ(states.size(), 2u);
        double pulls = 0;  // virtual work of all chains when all lengths grow alike
        for (const ChainSet::State& state : states)
            pulls += state.force_n * state.length_m / factor;
        const double h = 1e-6, up = set.add_energy(stretched(factor + h), 0.4, scratch),
                     down = set.add_energy(stretched(factor - h), 0.4, scratch);
        EXPECT_NEAR(pulls, (up - down) / (2 * h), 1e-4 * (1 + std::abs(pulls))) << factor;
    }
}

TEST(ChainSet, AtRestARelaxedChainDoesNotPull) {
    const TwoChains two;
    Points gradient = Points::Zero(10, 3);
    EXPECT_EQ(two.make(kMasseterLike).add_energy(two.rest, 0.0, gradient),
              two.make(kMasseterLike).add_energy(two.rest, 0.0, gradient));
    EXPECT_EQ(gradient.norm(), 0.0);
}

TEST(ChainSet, AtFullActivationTheTendonYieldsAndTheFibresShorten) {
    // Isometric at lam 0.9 with 18 mm of tendon and 22 mm of fibre: fl near 0.95 strains the tendon to about 3.2 %, so the
    // fibres lose 0.6 mm of their 22.
    const TwoChains two;
    const ChainSet set = two.make(kMasseterLike);
    EXPECT_NEAR(set.mean_stretch(two.rest, 1.0), 1 - 0.032 * 18 / 22, 4e-3);
    Points gradient = Points::Zero(10, 3);
    set.add_energy(two.rest, 1.0, gradient);
    EXPECT_NEAR(-gradient(0, 0), 10 * 0.95 * std::cos(0.28), 0.4);  // both ends pull inwards
    EXPECT_NEAR(gradient(4, 0), -gradient(0, 0), 1e-12);
}

TEST(ChainSet, OneTensionRunsThroughSegmentsOfDifferentLength) {
    const TwoChains two;
    const ChainSet set = two.make({.f0_n = 10});
    Points x = two.rest;
    x(2, 0) = 0.027;  // one segment is long, the next one short
    Points gradient = Points::Zero(10, 3);
    set.add_energy(x, 1.0, gradient);
    for (int i = 1; i < 4; ++i) EXPECT_NEAR(gradient.row(i).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace risorius::muscle
