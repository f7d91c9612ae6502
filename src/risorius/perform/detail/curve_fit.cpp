// SPDX-License-Identifier: MIT
#include "risorius/perform/detail/curve_fit.h"

#include <algorithm>
#include <cmath>

namespace risorius::perform {

namespace {

constexpr int kMostRounds = 300;
constexpr double kSmallChange = 1e-5, kHalf = 0.5, kTiny = 1e-15;

Eigen::VectorXd at(const Eigen::MatrixXd& columns, Eigen::Index c, double v) {
    const auto half = columns.col(2 * c), whole = columns.col(2 * c + 1);
    if (v <= kHalf) return 2 * v * half;
    return half + (2 * v - 1) * (whole - half);
}

/// The best value of one channel for what the others leave.
double best_value(const Eigen::MatrixXd& columns, Eigen::Index c, const Eigen::VectorXd& left,
                  double weight) {
    const Eigen::VectorXd first = 2 * columns.col(2 * c),
                          second = 2 * (columns.col(2 * c + 1) - columns.col(2 * c));
    const Eigen::VectorXd beyond = left - columns.col(2 * c) + kHalf * second;
    const double below =
        std::clamp(first.dot(left) / (first.squaredNorm() + weight + kTiny), 0.0, kHalf);
    const double above =
        std::clamp(second.dot(beyond) / (second.squaredNorm() + weight + kTiny), kHalf, 1.0);
    const auto price = [&](double v) {
        return (left - at(columns, c, v)).squaredNorm() + weight * v * v;
    };
    return price(below) <= price(above) ? below : above;
}

}  // namespace

Eigen::VectorXd curve_fit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& d,
                          const std::vector<double>& weights) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(columns.cols() / 2), rest = d;
    for (int round = 0; round < kMostRounds; ++round) {
        double largest = 0;
        for (Eigen::Index c = 0; c < values.size(); ++c) {
            const Eigen::VectorXd left = rest + at(columns, c, values[c]);
            const double value = best_value(columns, c, left, weights[static_cast<std::size_t>(c)]);
            largest = std::max(largest, std::abs(value - values[c]));
            values[c] = value;
            rest = left - at(columns, c, value);
        }
        if (largest < kSmallChange) break;
    }
    return values;
}

}  // namespace risorius::perform
