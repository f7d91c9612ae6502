// SPDX-License-Identifier: MIT
#include "risorius/solve/detail/simplicial_panels.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace risorius::solve::detail {
namespace {

/// Nodes of a grid in a plane, each with three rows, joined to their neighbours.
Eigen::SparseMatrix<double> plane(int size) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto join = [&](int a, int b) {
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                if (a != b || r >= c)
                    entries.emplace_back(3 * std::max(a, b) + r, 3 * std::min(a, b) + c,
                                         a == b && r == c ? 100.0 : 1.0);
    };
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) {
            join(i * size + j, i * size + j);
            if (i + 1 < size) join(i * size + j, (i + 1) * size + j);
            if (j + 1 < size) join(i * size + j, i * size + j + 1);
        }
    Eigen::SparseMatrix<double> out(3 * size * size, 3 * size * size);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

/// The rows of each column of the factor, by elimination of one column after another.
std::vector<std::set<int>> factor_rows(const Eigen::SparseMatrix<double>& A,
                                       const std::vector<int>& order) {
    std::vector<int> position(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        position[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    std::vector<std::set<int>> rows(order.size());
    for (int j = 0; j < A.outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) {
            const int a = position[static_cast<std::size_t>(it.row())],
                      b = position[static_cast<std::size_t>(j)];
            rows[static_cast<std::size_t>(std::min(a, b))].insert(std::max(a, b));
        }
    for (std::size_t j = 0; j < rows.size(); ++j)
        for (auto a = std::next(rows[j].begin()); a != rows[j].end(); ++a)
            rows[static_cast<std::size_t>(*a)].insert(a, rows[j].end());
    return rows;
}

long stored(const PanelPattern& of) {
    long sum = 0;
    for (std::size_t p = 0; p + 1 < of.super.size(); ++p) {
        const long width = of.super[p + 1] - of.super[p],
                   height = of.row_begin[p + 1] - of.row_begin[p];
        sum += width * height - width * (width - 1) / 2;
    }
    return sum;
}

TEST(SimplicialPanels, HoldTheFactorAndFewZerosMore) {
    const Eigen::SparseMatrix<double> A = plane(20);
    const PanelPattern cholmod = panel_pattern(A, nested_dissection(A, 3));
    const PanelPattern own = simplicial_panels(A, cholmod.order);
    const std::vector<std::set<int>> truth = factor_rows(A, own.order);
    ASSERT_EQ(own.super.front(), 0);
    ASSERT_EQ(own.super.back(), A.rows());
    long entries = 0;
    for (std::size_t p = 0; p + 1 < own.super.size(); ++p) {
        const auto first = own.row.begin() + own.row_begin[p],
                   last = own.row.begin() + own.row_begin[p + 1];
        ASSERT_TRUE(std::is_sorted(first, last));
        for (int j = own.super[p]; j < own.super[p + 1]; ++j) {
            EXPECT_EQ(first[j - own.super[p]], j);
            const std::set<int>& rows = truth[static_cast<std::size_t>(j)];
            entries += static_cast<long>(rows.size());
            EXPECT_TRUE(std::includes(first, last, rows.begin(), rows.end())) << "column " << j;
        }
    }
    EXPECT_GE(stored(own), entries);
    EXPECT_LT(stored(own), 1.3 * static_cast<double>(entries));
    EXPECT_NEAR(static_cast<double>(stored(own)), static_cast<double>(stored(cholmod)),
                0.1 * static_cast<double>(stored(cholmod)));
    EXPECT_LT(own.super.size(), 1.5 * static_cast<double>(cholmod.super.size()));
}

TEST(SimplicialPanels, OfADiagonalMatrixAreItsColumns) {
    Eigen::SparseMatrix<double> A(5, 5);
    A.setIdentity();
    const PanelPattern own = simplicial_panels(A, {4, 2, 0, 1, 3});
    EXPECT_EQ(own.super, (std::vector<int>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(own.row, (std::vector<int>{0, 1, 2, 3, 4}));
    EXPECT_EQ(own.order, (std::vector<int>{4, 2, 0, 1, 3}));
}

}  // namespace
}  // namespace risorius::solve::detail
