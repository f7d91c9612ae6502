// SPDX-License-Identifier: MIT
// Assembly of second derivatives, compared with a dense sum.
#include "risorius/solve/hessian_builder.h"

#include <gtest/gtest.h>

#include "risorius/solve/detail/conjugate_gradients.h"

namespace risorius::solve {
namespace {

/// A pseudo-random number that depends only on its index.
double number(int i) { return std::sin(12.9898 * i + 1.0) * 3.0; }

Mat3 block_of(int seed) {
    Mat3 block;
    for (int k = 0; k < 9; ++k) block.data()[k] = number(10 * seed + k);
    return block;
}

/// Dense counterpart of the builder.
struct Dense {
    explicit Dense(int nodes) : sum(Eigen::MatrixXd::Zero(3 * nodes, 3 * nodes)) {}
    void add(int i, int j, const Mat3& block) {
        sum.block<3, 3>(3 * i, 3 * j) += block;
        if (i != j) sum.block<3, 3>(3 * j, 3 * i) += block.transpose();
    }
    Eigen::MatrixXd sum;
};

Eigen::MatrixXd full(HessianBuilder& builder) {
    return Eigen::MatrixXd(Eigen::MatrixXd(builder.build()).selfadjointView<Eigen::Lower>());
}

Mat3 symmetric(const Mat3& block) { return block + block.transpose(); }

TEST(HessianBuilder, SumsBlocksNamedInEitherOrder) {
    HessianBuilder builder(4, {});
    Dense dense(4);
    const int pairs[][2] = {{0, 0}, {1, 1}, {2, 1}, {1, 2}, {3, 0}, {0, 3}, {3, 3}, {2, 1}};
    int seed = 0;
    for (const auto& [i, j] : pairs) {
        const Mat3 block = i == j ? symmetric(block_of(seed)) : block_of(seed);
        ++seed;
        builder.add(i, j, block);
        dense.add(i, j, block);
    }
    builder.add_diagonal(2, 4.5);
    dense.add(2, 2, 4.5 * Mat3::Identity());
    EXPECT_LT((full(builder) - dense.sum).norm(), 1e-13);
}

TEST(HessianBuilder, FixedNodesHaveTheIdentity) {
    HessianBuilder builder(3, {0, 1, 0});
    Dense dense(3);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j) {
            const Mat3 block = i == j ? symmetric(block_of(i + 7 * j)) : block_of(i + 7 * j);
            builder.add(i, j, block);
            dense.add(i, j, block);
        }
    dense.sum.middleRows(3, 3).setZero();
    dense.sum.middleCols(3, 3).setZero();
    dense.sum.block<3, 3>(3, 3).setIdentity();
    EXPECT_LT((full(builder) - dense.sum).norm(), 1e-13);
    EXPECT_EQ(builder.build().coeff(4, 4), 1.0);
}

TEST(HessianBuilder, ADenseElementIsTheSumOfItsBlocks) {
    const int nodes[] = {4, 0, 2};
    Eigen::Matrix<double, 9, 9, Eigen::RowMajor> element;
    for (int r = 0; r < 9; ++r)
        for (int c = 0; c <= r; ++c) element(r, c) = element(c, r) = number(r * 9 + c);
    HessianBuilder builder(5, {});
    builder.add_dense(nodes, 3, element.data());
    const Eigen::MatrixXd sum = full(builder);
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            EXPECT_EQ((sum.block<3, 3>(3 * nodes[a], 3 * nodes[b])),
                      (element.block<3, 3>(3 * a, 3 * b)));
    EXPECT_EQ(sum.row(3).norm(), 0.0);
}

TEST(HessianBuilder, ANewPatternAfterClearingIsThatOfANewBuilder) {
    HessianBuilder used(6, {0, 0, 1, 0, 0, 0});
    const auto assemble = [](HessianBuilder& builder, int variant) {
        for (int i = 0; i < 6; ++i) builder.add(i, i, symmetric(block_of(i + variant)));
        // Each variant has other pairs, another order and another number of calls.
        for (int k = 0; k < 3 + variant; ++k)
            builder.add((k + variant) % 6,
                        (2 * k + 1 + variant * variant) % 6 == (k + variant) % 6
                            ? (k + variant + 1) % 6
                            : (2 * k + 1 + variant * variant) % 6,
                        block_of(100 + k));
        if (variant % 2) builder.add_diagonal(5, variant);
    };
    for (const int variant : {0, 0, 1, 2, 1, 4, 0}) {
        used.clear();
        assemble(used, variant);
        HessianBuilder fresh(6, {0, 0, 1, 0, 0, 0});
        assemble(fresh, variant);
        EXPECT_EQ(full(used), full(fresh)) << variant;
        EXPECT_EQ(full(used), full(used)) << "built twice";
    }
}

TEST(HessianBuilder, ForgettingBeforeBuildingLosesNothingOfTheNextAssembly) {
    HessianBuilder builder(3, {});
    builder.add(2, 0, block_of(1));
    builder.clear();
    builder.add(2, 0, block_of(2));
    builder.add(1, 1, symmetric(block_of(3)));
    Dense dense(3);
    dense.add(2, 0, block_of(2));
    dense.add(1, 1, symmetric(block_of(3)));
    EXPECT_EQ(full(builder), dense.sum);
}

TEST(HessianBuilder, ItsBlocksMultiplyLikeItsMatrix) {
    HessianBuilder builder(5, {0, 0, 0, 1, 0});
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j <= i; j += 2)
            builder.add(i, j, i == j ? symmetric(block_of(i)) : block_of(5 * i + j));
    Points x(5, 3), y;
    for (int k = 0; k < 15; ++k) x.data()[k] = number(200 + k);
    multiply(builder.build_blocks(), x, y);
    const Eigen::VectorXd expected =
        full(builder) * Eigen::Map<const Eigen::VectorXd>(x.data(), 15);
    EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(y.data(), 15) - expected).norm(), 1e-12);
}

}  // namespace
}  // namespace risorius::solve
