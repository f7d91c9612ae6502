// SPDX-License-Identifier: MIT
#include "risorius/solve/detail/dense_panels.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace risorius::solve::detail {
namespace {

template <class Real>
class DensePanels : public testing::Test {
  public:
    using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
    static constexpr double kTolerance = sizeof(Real) == 8 ? 1e-13 : 2e-5;

    /// Numbers followed by those that may be read beyond.
    static std::vector<Real> padded(const Matrix& numbers, Real beyond) {
        std::vector<Real> out(numbers.data(), numbers.data() + numbers.size());
        out.insert(out.end(), kReadBeyond, beyond);
        return out;
    }
    static Matrix some_panel(int tall, int width) {
        Matrix panel(tall, width);
        for (int j = 0; j < width; ++j)
            for (int i = 0; i < tall; ++i)
                panel(i, j) = static_cast<Real>(
                    i == j ? 3 + j : (0.1 * ((7 * i + 3 * j) % 11) - 0.4) / std::sqrt(width));
        return panel;
    }
};
using BothPrecisions = testing::Types<double, float>;
TYPED_TEST_SUITE(DensePanels, BothPrecisions);

// Heights around the rows that are taken together, widths around the columns. What lies beyond counts nothing.
template <class Check>
void for_all_sizes(const Check& check) {
    for (int width = 1; width <= 13; ++width)
        for (int below = 0; below <= 35; below += below < 10 ? 1 : 5) check(width, below);
}

TYPED_TEST(DensePanels, EliminateSolvesTheTriangleAndSubtractsWhatIsBelow) {
    using Numbers = typename TestFixture::Vector;
    for_all_sizes([&](int width, int below) {
        const int tall = width + below;
        const auto panel = this->some_panel(tall, width);
        const Numbers known = Numbers::LinSpaced(width, -1, 2);
        Numbers right = Numbers::Constant(tall, TypeParam(0.25));
        right.head(width) = panel.topRows(width).template triangularView<Eigen::Lower>() * known;
        std::vector<TypeParam> w = this->padded(right, 1e3);
        eliminate(this->padded(panel, 1e3).data(), tall, width, w.data());
        const Numbers found = Eigen::Map<Numbers>(w.data(), tall);
        EXPECT_LT((found.head(width) - known).norm(), this->kTolerance) << width << " x " << below;
        const Numbers left =
            Numbers::Constant(below, TypeParam(0.25)) - panel.bottomRows(below) * known;
        EXPECT_LT((found.tail(below) - left).norm(), this->kTolerance) << width << " x " << below;
    });
}

TYPED_TEST(DensePanels, SubstituteSolvesTheTransposedTriangle) {
    using Numbers = typename TestFixture::Vector;
    for_all_sizes([&](int width, int below) {
        const int tall = width + below;
        const auto panel = this->some_panel(tall, width);
        const Numbers known = Numbers::LinSpaced(tall, -1, 2);
        Numbers right = known;
        right.head(width) =
            panel.topRows(width).template triangularView<Eigen::Lower>().transpose() *
                known.head(width) +
            panel.bottomRows(below).transpose() * known.tail(below);
        std::vector<TypeParam> w = this->padded(right, 1e3);
        substitute(this->padded(panel, 1e3).data(), tall, width, w.data());
        const Numbers found = Eigen::Map<Numbers>(w.data(), tall);
        EXPECT_LT((found - known).norm(), this->kTolerance * known.norm())
            << width << " x " << below;
    });
}

TYPED_TEST(DensePanels, ProductsAreThoseOfTheLowerPart) {
    using Panel = typename TestFixture::Matrix;
    constexpr int kInner = 7;
    for_all_sizes([&](int n, int below) {
        const int m = n + below;
        const Panel a = this->some_panel(m, kInner);
        const Panel wanted = a * a.topRows(n).transpose();
        std::vector<TypeParam> c(static_cast<std::size_t>(stored_rows<TypeParam>(m)) *
                                 static_cast<std::size_t>(n));
        const std::vector<TypeParam> numbers = this->padded(a, 1e3);
        product(numbers.data(), m, numbers.data(), m, m, n, kInner, c.data());
        double worst = 0;
        for (int j = 0; j < n; ++j)
            for (int i = j; i < m; ++i)
                worst = std::max(
                    worst, std::abs(static_cast<double>(
                               c[static_cast<std::size_t>(j * stored_rows<TypeParam>(m) + i)] -
                               wanted(i, j))));
        EXPECT_LT(worst, 10 * this->kTolerance) << m << " x " << n;
    });
}

TYPED_TEST(DensePanels, FactorisedPanelsGiveTheMatrixAgain) {
    using Panel = typename TestFixture::Matrix;
    for (const int width : {1, 3, 31, 32, 33, 70})
        for (const int below : {0, 5}) {
            const int tall = width + below;
            Panel lower = this->some_panel(tall, width);
            for (int j = 0; j < width; ++j) lower.col(j).head(j).setZero();
            const Panel wanted = lower * lower.topRows(width).transpose();
            std::vector<TypeParam> panel = this->padded(wanted, 0), scratch;
            ASSERT_TRUE(factorise_panel(panel.data(), tall, width, scratch));
            double worst = 0;
            for (int j = 0; j < width; ++j)
                for (int i = j; i < tall; ++i)
                    worst = std::max(
                        worst, std::abs(static_cast<double>(
                                   panel[static_cast<std::size_t>(j * tall + i)] - lower(i, j))));
            EXPECT_LT(worst, 100 * this->kTolerance) << width << " x " << below;
        }
}

}  // namespace
}  // namespace risorius::solve::detail
