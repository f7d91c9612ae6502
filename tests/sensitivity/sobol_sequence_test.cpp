// SPDX-License-Identifier: MIT
// The points of the sequence against published ones and against the laws of nets.
#include "risorius/sensitivity/sobol_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "risorius/sensitivity/unit_sample.h"

namespace risorius::sensitivity {
namespace {

// Bratley & Fox 1988, ACM Trans. Math. Softw. 14, 88-100; the same in Joe & Kuo, "Notes on generating Sobol' sequences" (2008).
// The first three coordinates leave no choice: their polynomials are 1, x + 1 and x^2 + x + 1 with m = 1, 3.
TEST(SobolPoints, FirstTenAreThePublishedOnes) {
    const double published[10][3] = {{0, 0, 0},
                                     {0.5, 0.5, 0.5},
                                     {0.75, 0.25, 0.25},
                                     {0.25, 0.75, 0.75},
                                     {0.375, 0.375, 0.625},
                                     {0.875, 0.875, 0.125},
                                     {0.625, 0.125, 0.875},
                                     {0.125, 0.625, 0.375},
                                     {0.1875, 0.3125, 0.9375},
                                     {0.6875, 0.8125, 0.4375}};
    const SobolSequence sequence(3);
    for (std::uint32_t n = 0; n < 10; ++n)
        for (int d = 0; d < 3; ++d) EXPECT_EQ(sequence.at(n, d), published[n][d]) << n << " " << d;
}

// Of 2^m points from a multiple of 2^m on, each interval of length 2^-m has one.
TEST(SobolPoints, FillEveryIntervalOnceInEachCoordinate) {
    const SobolSequence sequence(SobolSequence::kMaxDimensions);
    for (int d = 0; d < sequence.dimensions(); ++d)
        for (const std::uint32_t block : {0u, 5u}) {
            std::set<std::uint32_t> intervals;
            for (std::uint32_t n = 0; n < 256; ++n)
                intervals.insert(sequence.bits(256 * block + n, d) >> 24);
            EXPECT_EQ(intervals.size(), 256u) << d;
        }
}

// The quality t is what counting says: each box of area 2^(t-m) has 2^t points, and for t - 1 some box has not.
TEST(SobolPoints, PairsAreNetsOfTheQualityThatIsTold) {
    constexpr int kM = 7;
    const SobolSequence sequence(12);
    const auto is_net = [&](int t, int one, int other) {
        for (int i = 0; i <= kM - t; ++i) {
            const int j = kM - t - i;
            std::vector<int> boxes(std::size_t{1} << (kM - t), 0);
            for (std::uint32_t n = 0; n < (1u << kM); ++n) {
                const auto row = static_cast<std::uint64_t>(sequence.bits(n, one)) >> (32 - i);
                const auto column = static_cast<std::uint64_t>(sequence.bits(n, other)) >> (32 - j);
                ++boxes[static_cast<std::size_t>((row << j) + column)];
            }
            for (const int points : boxes)
                if (points != 1 << t) return false;
        }
        return true;
    };
    for (int one = 0; one < sequence.dimensions(); ++one)
        for (int other = 0; other < one; ++other) {
            const int t = sequence.net_quality(kM, one, other);
            EXPECT_TRUE(is_net(t, one, other)) << one << " " << other;
            EXPECT_TRUE(t == 0 || !is_net(t - 1, one, other)) << one << " " << other;
        }
}

TEST(SobolPoints, FirstTwoCoordinatesAreThePerfectNet) {
    const SobolSequence sequence(2);
    for (int m = 1; m <= 20; ++m) EXPECT_EQ(sequence.net_quality(m, 0, 1), 0) << m;
}

// At 256 points. 20 coordinates are those of a study with ten parameters.
TEST(SobolPoints, PairsOfCoordinatesAreGood) {
    const SobolSequence sequence(SobolSequence::kMaxDimensions);
    int worst_of_first = 0;
    double sum = 0, pairs = 0;
    for (int one = 0; one < sequence.dimensions(); ++one)
        for (int other = 0; other < one; ++other) {
            const int t = sequence.net_quality(8, one, other);
            if (one < 20) worst_of_first = std::max(worst_of_first, t);
            sum += t;
            ++pairs;
        }
    EXPECT_LE(worst_of_first, 5);
    EXPECT_LT(sum / pairs, 2.5);
}

// The integral of the product of 3/2 x^(1/2) over six coordinates is 1. The product has a variance of (9/8)^6 - 1 = 1.03, of which sums of
// functions of one coordinate, which a Latin hypercube integrates nearly without error, are 6/8.
TEST(SobolPoints, IntegrateBetterThanRandomOnes) {
    constexpr int kCount = 4096, kDimensions = 6;
    const auto integral = [&](Sampling sampling) {
        const Eigen::MatrixXd points = unit_sample(sampling, kCount, kDimensions, 7);
        double sum = 0;
        for (Eigen::Index i = 0; i < points.rows(); ++i) {
            double product = 1;
            for (Eigen::Index d = 0; d < points.cols(); ++d)
                product *= 1.5 * std::sqrt(points(i, d));
            sum += product;
        }
        return sum / kCount;
    };
    EXPECT_LT(std::abs(integral(Sampling::kSobol) - 1), 5e-4);
    EXPECT_LT(std::abs(integral(Sampling::kLatinHypercube) - 1), 4 * std::sqrt(0.28 / kCount));
    EXPECT_LT(std::abs(integral(Sampling::kRandom) - 1), 4 * std::sqrt(1.03 / kCount));
}

TEST(UnitSamples, LatinHypercubeHasOnePointInEveryRow) {
    const Eigen::MatrixXd points = unit_sample(Sampling::kLatinHypercube, 50, 4, 3);
    for (Eigen::Index d = 0; d < 4; ++d) {
        std::set<int> rows;
        for (Eigen::Index i = 0; i < 50; ++i) rows.insert(static_cast<int>(50 * points(i, d)));
        EXPECT_EQ(rows.size(), 50u);
        EXPECT_EQ(*rows.begin(), 0);
        EXPECT_EQ(*rows.rbegin(), 49);
    }
}

TEST(UnitSamples, DependOnTheSeedAloneAndLieInside) {
    for (const Sampling sampling :
         {Sampling::kSobol, Sampling::kLatinHypercube, Sampling::kRandom}) {
        const Eigen::MatrixXd points = unit_sample(sampling, 64, 5, 11);
        EXPECT_GT(points.minCoeff(), 0);
        EXPECT_LT(points.maxCoeff(), 1);
        EXPECT_EQ(points, unit_sample(sampling, 64, 5, 11));
        EXPECT_NE(points, unit_sample(sampling, 64, 5, 12));
    }
    EXPECT_EQ(unit_sample(Sampling::kSobol, 32, 5, 11),
              unit_sample(Sampling::kSobol, 64, 5, 11).topRows(32));
}

}  // namespace
}  // namespace risorius::sensitivity
