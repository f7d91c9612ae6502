// SPDX-License-Identifier: MIT
// Indices against functions whose indices are known.
#include "risorius/sensitivity/sobol_indices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "risorius/sensitivity/unit_sample.h"

namespace risorius::sensitivity {
namespace {

using Function = double (*)(const Eigen::RowVectorXd&);

SampledResults sampled(Function f, int dimensions, int count, Sampling sampling,
                       std::uint64_t seed = 1) {
    const Eigen::MatrixXd points = unit_sample(sampling, count, 2 * dimensions, seed);
    const Eigen::MatrixXd a = points.leftCols(dimensions), b = points.rightCols(dimensions);
    const auto values = [&](const Eigen::MatrixXd& at) {
        Eigen::MatrixXd out(at.rows(), 1);
        for (Eigen::Index i = 0; i < at.rows(); ++i) out(i, 0) = f(at.row(i));
        return out;
    };
    SampledResults out{values(a), values(b), {}};
    for (int d = 0; d < dimensions; ++d) {
        Eigen::MatrixXd ab = a;
        ab.col(d) = b.col(d);
        out.ab.push_back(values(ab));
    }
    return out;
}

double ishigami(const Eigen::RowVectorXd& u) {
    const double x1 = std::numbers::pi * (2 * u[0] - 1), x2 = std::numbers::pi * (2 * u[1] - 1),
                 x3 = std::numbers::pi * (2 * u[2] - 1);
    return std::sin(x1) + 7 * std::pow(std::sin(x2), 2) + 0.1 * std::pow(x3, 4) * std::sin(x1);
}

// Ishigami & Homma 1990, in closed form with a = 7, b = 0.1:
//   V1 = (1 + b pi^4 / 5)^2 / 2, V2 = a^2 / 8, V13 = b^2 pi^8 (1/18 - 1/50)
TEST(SobolIndicesLaws, IshigamiHasItsClosedForm) {
    const double pi4 = std::pow(std::numbers::pi, 4);
    const double v1 = 0.5 * std::pow(1 + 0.1 * pi4 / 5, 2), v2 = 49.0 / 8,
                 v13 = 0.01 * pi4 * pi4 * (1.0 / 18 - 1.0 / 50), v = v1 + v2 + v13;
    EXPECT_NEAR(v, 13.8446, 1e-4);  // as published
    EXPECT_NEAR(v1 / v, 0.3139, 1e-4);
    EXPECT_NEAR(v2 / v, 0.4424, 1e-4);
    const double first[] = {v1 / v, v2 / v, 0}, total[] = {(v1 + v13) / v, v2 / v, v13 / v};
    for (const Sampling sampling : {Sampling::kSobol, Sampling::kLatinHypercube}) {
        const auto indices = sobol_indices(sampled(ishigami, 3, 8192, sampling));
        for (std::size_t i = 0; i < 3; ++i) {
            const double near = sampling == Sampling::kSobol ? 0.01 : 0.03;
            EXPECT_NEAR(indices[i].first.value, first[i], near) << i;
            EXPECT_NEAR(indices[i].total.value, total[i], near) << i;
        }
    }
}

constexpr double kG[] = {0, 1, 4.5, 9, 99, 99, 99, 99};

double g_function(const Eigen::RowVectorXd& u) {
    double product = 1;
    for (Eigen::Index i = 0; i < 8; ++i) product *= (std::abs(4 * u[i] - 2) + kG[i]) / (1 + kG[i]);
    return product;
}

// Saltelli & Sobol' 1995: V_i = 1 / (3 (1 + a_i)^2), and the variance is the product of 1 + V_i less 1.
TEST(SobolIndicesLaws, GFunctionHasItsClosedForm) {
    double all = 1;
    for (const double a : kG) all *= 1 + 1 / (3 * (1 + a) * (1 + a));
    const auto indices = sobol_indices(sampled(g_function, 8, 8192, Sampling::kSobol));
    double sum = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        const double v = 1 / (3 * (1 + kG[i]) * (1 + kG[i]));
        EXPECT_NEAR(indices[i].first.value, v / (all - 1), 0.01) << i;
        EXPECT_NEAR(indices[i].total.value, v * all / (1 + v) / (all - 1), 0.01) << i;
        EXPECT_LE(indices[i].first.low, indices[i].first.value);
        EXPECT_GE(indices[i].first.high, indices[i].first.value);
        sum += indices[i].first.value;
    }
    EXPECT_NEAR(indices[0].first.value, 0.716, 0.01);  // as published
    EXPECT_NEAR(indices[1].first.value, 0.179, 0.01);
    EXPECT_LT(sum, 1);
}

// Of 100 independent studies of 128 rows, the interval of 95 % has the truth in most.
TEST(SobolIndicesLaws, IntervalsOfTheBootstrapHaveTheTruthInThem) {
    int has_first = 0, has_total = 0;
    const double v = 1.0 / 12 + 4.0 / 12;
    const Function sum = [](const Eigen::RowVectorXd& u) { return u[0] + 2 * u[1]; };
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const auto one = sobol_indices(sampled(sum, 2, 128, Sampling::kRandom, seed),
                                       {.replicates = 200, .seed = seed})[0];
        const double truth = 1.0 / 12 / v;
        has_first += one.first.low <= truth && truth <= one.first.high;
        has_total += one.total.low <= truth && truth <= one.total.high;
    }
    // Binomial(100, 0.95) is below 85 in less than one of 10,000 cases; percentile intervals are a little narrow.
    EXPECT_GE(has_first, 85);
    EXPECT_GE(has_total, 85);
}

// A point in space: each component adds its variances. y = (p1, 3 p2, 0): S = 1 / 10 and 9 / 10.
TEST(SobolIndicesLaws, ComponentsOfAPointAreAddedUp) {
    const Eigen::MatrixXd points = unit_sample(Sampling::kSobol, 4096, 4, 1);
    const auto at = [&](int p1, int p2) {
        Eigen::MatrixXd out = Eigen::MatrixXd::Zero(points.rows(), 3);
        out.col(0) = points.col(p1);
        out.col(1) = 3 * points.col(p2);
        return out;
    };
    const auto indices = sobol_indices({at(0, 1), at(2, 3), {at(2, 1), at(0, 3)}});
    EXPECT_NEAR(indices[0].first.value, 0.1, 2e-3);
    EXPECT_NEAR(indices[1].first.value, 0.9, 2e-3);
    EXPECT_NEAR(indices[0].total.value, 0.1, 2e-3);
    EXPECT_NEAR(indices[1].total.value, 0.9, 2e-3);
}

TEST(SobolIndicesLaws, WhatDoesNotVaryHasNoIndices) {
    const Eigen::MatrixXd none = Eigen::MatrixXd::Constant(16, 3, 0.25);
    const auto indices = sobol_indices({none, none, {none}});
    EXPECT_TRUE(std::isnan(indices[0].first.value));
    EXPECT_TRUE(std::isnan(indices[0].total.low));
}

TEST(SobolIndicesLaws, SameSeedSameBytes) {
    const auto results = sampled(ishigami, 3, 256, Sampling::kSobol);
    const auto one = sobol_indices(results), again = sobol_indices(results);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(one[i].first.low, again[i].first.low);
        EXPECT_EQ(one[i].total.high, again[i].total.high);
    }
}

}  // namespace
}  // namespace risorius::sensitivity
