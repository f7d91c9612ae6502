// SPDX-License-Identifier: MIT
#include "risorius/sensitivity/sobol_indices.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "risorius/core/counter_rng.h"

namespace risorius::sensitivity {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The summands of the estimators, a row for each row of the samples.
struct Summands {
    Eigen::MatrixXd sums;          ///< y_A + y_B, N x components
    Eigen::VectorXd squares;       ///< |y_A|^2 + |y_B|^2
    Eigen::MatrixXd first, total;  ///< N x parameters
};

Summands summands_of(const SampledResults& results) {
    const Eigen::RowVectorXd mean = 0.5 * (results.a.colwise().mean() + results.b.colwise().mean());
    const Eigen::MatrixXd a = results.a.rowwise() - mean, b = results.b.rowwise() - mean;
    Summands out;
    out.sums = a + b;
    out.squares = a.rowwise().squaredNorm() + b.rowwise().squaredNorm();
    const auto parameters = static_cast<Eigen::Index>(results.ab.size());
    out.first.resize(a.rows(), parameters);
    out.total.resize(a.rows(), parameters);
    for (Eigen::Index i = 0; i < parameters; ++i) {
        const Eigen::MatrixXd change =
            (results.ab[static_cast<std::size_t>(i)].rowwise() - mean) - a;
        out.first.col(i) = b.cwiseProduct(change).rowwise().sum();
        out.total.col(i) = 0.5 * change.rowwise().squaredNorm();
    }
    return out;
}

/// First-order and total indices from the rows `rows`; 2 x parameters.
Eigen::MatrixXd indices_of(const Summands& summands, const std::vector<Eigen::Index>& rows) {
    const auto n = static_cast<double>(rows.size());
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(summands.sums.cols());
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(2, summands.first.cols());
    double squares = 0;
    for (const Eigen::Index row : rows) {
        sum += summands.sums.row(row);
        squares += summands.squares[row];
        out.row(0) += summands.first.row(row);
        out.row(1) += summands.total.row(row);
    }
    const double variance = squares / (2 * n) - (sum / (2 * n)).squaredNorm();
    if (!(variance > 0)) return Eigen::MatrixXd::Constant(2, out.cols(), kNone);
    return out / (n * variance);
}

Estimate with_interval(double value, std::vector<double> replicates) {
    replicates.erase(std::remove_if(replicates.begin(), replicates.end(),
                                    [](double r) { return !std::isfinite(r); }),
                     replicates.end());
    return {value, quantile_of(replicates, 0.025), quantile_of(replicates, 0.975)};
}

}  // namespace

double quantile_of(std::vector<double> values, double fraction) {
    if (values.empty()) return kNone;
    std::sort(values.begin(), values.end());
    const double place = fraction * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    const double share = place - static_cast<double>(below);
    return (1 - share) * values[below] + share * values[above];
}

std::vector<SobolIndices> sobol_indices(const SampledResults& results,
                                        const IndexOptions& options) {
    const Summands summands = summands_of(results);
    const Eigen::Index count = results.a.rows();
    std::vector<Eigen::Index> rows(static_cast<std::size_t>(count));
    for (Eigen::Index i = 0; i < count; ++i) rows[static_cast<std::size_t>(i)] = i;
    const Eigen::MatrixXd values = indices_of(summands, rows);

    std::vector<Eigen::MatrixXd> replicates;
    for (int r = 0; r < options.replicates; ++r) {
        const CounterRng random = CounterRng(options.seed).at(static_cast<std::uint64_t>(r));
        for (Eigen::Index i = 0; i < count; ++i)
            rows[static_cast<std::size_t>(i)] = static_cast<Eigen::Index>(
                CounterRng(random).at(static_cast<std::uint64_t>(i)).uniform() *
                static_cast<double>(count));
        replicates.push_back(indices_of(summands, rows));
    }
    std::vector<SobolIndices> out;
    for (Eigen::Index p = 0; p < values.cols(); ++p) {
        std::vector<double> first, total;
        for (const Eigen::MatrixXd& replicate : replicates) {
            first.push_back(replicate(0, p));
            total.push_back(replicate(1, p));
        }
        out.push_back({with_interval(values(0, p), first), with_interval(values(1, p), total)});
    }
    return out;
}

}  // namespace risorius::sensitivity
