// SPDX-License-Identifier: MIT
#include "risorius/solve/bounded_curve.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace risorius::solve {

namespace {

enum class State : char { kFree, kAtMin, kAtMax };

/// Rounds in which all unknowns may change although fewer did not become infeasible.
constexpr int kPatience = 10;
/// The same, with one change in each run of neighbours.
constexpr int kPatienceOfRuns = 60;
/// Conditions hold within this fraction of the scale of the problem.
constexpr double kTolerance = 1e-8;

/// Solves for the free unknowns, with the others at their bounds: L D L^T of five diagonals, in which the rows of fixed unknowns
/// are those of the identity.
void solve_free(const CurveQuadratic& q, const std::vector<State>& state, Eigen::VectorXd& x) {
    const long n = q.b.size();
    const auto free = [&](long i) { return state[static_cast<std::size_t>(i)] == State::kFree; };
    Eigen::VectorXd d(n), l1(n), l2(n), y(n);
    for (long i = 0; i < n; ++i) {
        if (!free(i)) {
            x[i] = state[static_cast<std::size_t>(i)] == State::kAtMin ? q.min[i] : q.max[i];
            d[i] = 1;
            l1[i] = l2[i] = 0;
        }
    }
    for (long i = 0; i < n; ++i) {
        if (!free(i)) {
            y[i] = x[i];
            continue;
        }
        // Row i of A left of the diagonal; fixed neighbours move to the right-hand side.
        double a1 = 0, a2 = 0, right = q.b[i];
        const auto couple = [&](long j, double a, double& inside) {
            if (free(j))
                inside = a;
            else
                right -= a * x[j];
        };
        double ignored = 0;
        if (i >= 1) couple(i - 1, q.first[i - 1], a1);
        if (i >= 2) couple(i - 2, q.second[i - 2], a2);
        if (i + 1 < n && !free(i + 1)) couple(i + 1, q.first[i], ignored);
        if (i + 2 < n && !free(i + 2)) couple(i + 2, q.second[i], ignored);
        // Factors: l2[i] couples i with i - 2, l1[i] with i - 1.
        l2[i] = i >= 2 ? a2 / d[i - 2] : 0;
        const double mixed = i >= 2 ? l2[i] * d[i - 2] * l1[i - 1] : 0;
        l1[i] = i >= 1 ? (a1 - mixed) / d[i - 1] : 0;
        d[i] = q.diagonal[i];
        if (i >= 1) d[i] -= l1[i] * l1[i] * d[i - 1];
        if (i >= 2) d[i] -= l2[i] * l2[i] * d[i - 2];
        y[i] = right;
        if (i >= 1) y[i] -= l1[i] * y[i - 1];
        if (i >= 2) y[i] -= l2[i] * y[i - 2];
    }
    for (long i = n - 1; i >= 0; --i) {
        if (!free(i)) continue;
        double value = y[i] / d[i];
        if (i + 1 < n && free(i + 1)) value -= l1[i + 1] * x[i + 1];
        if (i + 2 < n && free(i + 2)) value -= l2[i + 2] * x[i + 2];
        x[i] = value;
    }
}

Eigen::VectorXd slope_of(const CurveQuadratic& q, const Eigen::VectorXd& x) {
    const long n = x.size();
    Eigen::VectorXd g = q.diagonal.cwiseProduct(x) - q.b;
    for (long i = 0; i + 1 < n; ++i) {
        g[i] += q.first[i] * x[i + 1];
        g[i + 1] += q.first[i] * x[i];
    }
    for (long i = 0; i + 2 < n; ++i) {
        g[i] += q.second[i] * x[i + 2];
        g[i + 2] += q.second[i] * x[i];
    }
    return g;
}

using Changes = std::vector<std::pair<long, State>>;

/// Of neighbouring unknowns that change to the same state, the one in the middle.
Changes middle_of_runs(const Changes& changes) {
    Changes out;
    for (std::size_t begin = 0; begin < changes.size();) {
        std::size_t end = begin + 1;
        while (end < changes.size() && changes[end].first == changes[end - 1].first + 1 &&
               changes[end].second == changes[begin].second)
            ++end;
        out.push_back(changes[(begin + end - 1) / 2]);
        begin = end;
    }
    return out;
}

}  // namespace

CurveQuadratic::CurveQuadratic(long n)
    : diagonal(Eigen::VectorXd::Zero(n)),
      first(Eigen::VectorXd::Zero(n)),
      second(Eigen::VectorXd::Zero(n)),
      b(Eigen::VectorXd::Zero(n)),
      min(Eigen::VectorXd::Constant(n, -std::numeric_limits<double>::infinity())),
      max(Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity())) {}

void CurveQuadratic::pull(long i, double target, double weight) {
    diagonal[i] += weight;
    b[i] += weight * target;
}

void CurveQuadratic::bend(double weight) {
    for (long i = 1; i + 1 < b.size(); ++i) {
        diagonal[i - 1] += weight;
        diagonal[i] += 4 * weight;
        diagonal[i + 1] += weight;
        first[i - 1] -= 2 * weight;
        first[i] -= 2 * weight;
        second[i - 1] += weight;
    }
}

CurveSolution minimise(const CurveQuadratic& problem, int max_rounds) {
    const long n = problem.b.size();
    std::vector<State> state(static_cast<std::size_t>(n), State::kFree);
    for (long i = 0; i < n; ++i)
        if (problem.min[i] == problem.max[i]) state[static_cast<std::size_t>(i)] = State::kAtMin;
    CurveSolution out;
    out.x = Eigen::VectorXd::Zero(n);
    long fewest = n + 1;
    int patience = kPatience;
    const double slope_scale =
        kTolerance * (problem.diagonal.size() ? problem.diagonal.maxCoeff() : 1);
    while (out.rounds < max_rounds) {
        ++out.rounds;
        solve_free(problem, state, out.x);
        const Eigen::VectorXd slope = slope_of(problem, out.x);
        Changes changes;
        for (long i = 0; i < n; ++i) {
            const double tolerance = kTolerance * std::max(1.0, std::abs(out.x[i]));
            switch (state[static_cast<std::size_t>(i)]) {
                case State::kFree:
                    if (out.x[i] < problem.min[i] - tolerance)
                        changes.emplace_back(i, State::kAtMin);
                    else if (out.x[i] > problem.max[i] + tolerance)
                        changes.emplace_back(i, State::kAtMax);
                    break;
                case State::kAtMin:
                    if (slope[i] < -slope_scale && problem.min[i] < problem.max[i])
                        changes.emplace_back(i, State::kFree);
                    break;
                case State::kAtMax:
                    if (slope[i] > slope_scale) changes.emplace_back(i, State::kFree);
                    break;
            }
        }
        if (changes.empty()) {
            out.converged = true;
            break;
        }
        const auto count = static_cast<long>(changes.size());
        if (count < fewest) {
            fewest = count;
            patience = kPatience;
        } else {
            --patience;
        }
        // Neighbours that break conditions together hide which of them matters: the middle one of each run.
        if (patience < 0 && patience >= -kPatienceOfRuns)
            changes = middle_of_runs(changes);
        else if (patience < -kPatienceOfRuns)
            changes.erase(changes.begin(), changes.end() - 1);
        for (const auto& [i, to] : changes) state[static_cast<std::size_t>(i)] = to;
    }
    out.x = out.x.cwiseMax(problem.min).cwiseMin(problem.max);
    return out;
}

}  // namespace risorius::solve
