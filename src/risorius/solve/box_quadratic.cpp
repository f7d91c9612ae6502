// SPDX-License-Identifier: MIT
#include "risorius/solve/box_quadratic.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace risorius::solve {

namespace {

enum class Place { kMin, kZero, kMax, kBelowZero, kAboveZero };

Place place_of(const BoxQuadratic& problem, const Eigen::VectorXd& x, long i) {
    if (x[i] == problem.min[i]) return Place::kMin;
    if (x[i] == problem.max[i]) return Place::kMax;
    if (x[i] == 0 && problem.l1_weight[i] > 0) return Place::kZero;
    return x[i] < 0 ? Place::kBelowZero : Place::kAboveZero;
}

// Moves the free unknowns to their common minimum while the others stay. An unknown that reaches a bound or 0 on the way stays
// there.
void jump(const BoxQuadratic& problem, const std::vector<Place>& places, Eigen::VectorXd& x,
          Eigen::VectorXd& slope) {
    std::vector<long> free;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i] == Place::kBelowZero || places[i] == Place::kAboveZero)
            free.push_back(static_cast<long>(i));
    while (free.size() > 1) {  // a single free unknown is left to the sweeps
        const auto count = static_cast<long>(free.size());
        const auto unknown = [&](long k) { return free[static_cast<std::size_t>(k)]; };
        Eigen::MatrixXd A(count, count);
        Eigen::VectorXd down(count);
        for (long k = 0; k < count; ++k) {
            const long i = unknown(k);
            for (long l = 0; l < count; ++l) A(k, l) = problem.A(i, unknown(l));
            down[k] = -slope[i] - std::copysign(problem.l1_weight[i], x[i]);
        }
        const Eigen::LLT<Eigen::MatrixXd> factor(A);
        if (factor.info() != Eigen::Success) return;
        const Eigen::VectorXd step = factor.solve(down);
        double way = 1, stop = 0;
        long first = -1;
        for (long k = 0; k < count; ++k) {
            const long i = unknown(k);
            const bool weighted = problem.l1_weight[i] > 0;
            double end = step[k] > 0 ? problem.max[i] : problem.min[i];
            if (weighted && x[i] * step[k] < 0 && x[i] * end < 0) end = 0;
            if (!(std::abs(step[k]) * way > std::abs(end - x[i]))) continue;
            way = (end - x[i]) / step[k];
            stop = end;
            first = k;
        }
        for (long k = 0; k < count; ++k) x[unknown(k)] += way * step[k];
        if (first >= 0) x[unknown(first)] = stop;
        slope = problem.A * x + problem.b;
        if (first < 0) return;
        free.erase(free.begin() + first);
    }
}

}  // namespace

int minimise(const BoxQuadratic& problem, Eigen::VectorXd& x, double tolerance, int sweeps) {
    x = x.cwiseMax(problem.min).cwiseMin(problem.max);
    Eigen::VectorXd slope = problem.A * x + problem.b;  // without the L1 weight
    std::vector<Place> places(static_cast<std::size_t>(x.size())), before;
    bool jumped = false;  // from the present places
    for (int sweep = 1; sweep <= sweeps; ++sweep) {
        double max = 0;
        for (long i = 0; i < x.size(); ++i) {
            const double curvature = problem.A(i, i);
            if (!(curvature > 0)) continue;
            // Without bounds, the minimum in this coordinate is at `free`, pulled towards 0 by the L1 weight.
            const double free = x[i] - slope[i] / curvature;
            const double drawn = std::max(0.0, std::abs(free) - problem.l1_weight[i] / curvature);
            const double next =
                std::clamp(std::copysign(drawn, free), problem.min[i], problem.max[i]);
            const double change = next - x[i];
            if (change == 0) continue;
            slope += change * problem.A.col(i);
            x[i] = next;
            max = std::max(max, std::abs(change));
        }
        if (max <= tolerance) return sweep;
        for (long i = 0; i < x.size(); ++i)
            places[static_cast<std::size_t>(i)] = place_of(problem, x, i);
        if (places != before) {
            before = places;
            jumped = false;
        } else if (!jumped) {
            jumped = true;
            jump(problem, places, x, slope);
        }
    }
    return sweeps;
}

}  // namespace risorius::solve
