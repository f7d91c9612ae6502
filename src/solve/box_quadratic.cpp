#include "solve/box_quadratic.h"

#include <algorithm>
#include <cmath>

namespace risorius::solve {

int minimise(const BoxQuadratic& problem, Eigen::VectorXd& x, double tolerance, int sweeps) {
    x = x.cwiseMax(problem.least).cwiseMin(problem.most);
    Eigen::VectorXd slope = problem.A * x + problem.b;  // without the price
    for (int sweep = 1; sweep <= sweeps; ++sweep) {
        double greatest = 0;
        for (long i = 0; i < x.size(); ++i) {
            const double curvature = problem.A(i, i);
            if (!(curvature > 0)) continue;
            // Without limits the minimum lies at `free`, drawn towards 0 by the price
            const double free = x[i] - slope[i] / curvature;
            const double drawn = std::max(0.0, std::abs(free) - problem.price[i] / curvature);
            const double next =
                std::clamp(std::copysign(drawn, free), problem.least[i], problem.most[i]);
            const double change = next - x[i];
            if (change == 0) continue;
            slope += change * problem.A.col(i);
            x[i] = next;
            greatest = std::max(greatest, std::abs(change));
        }
        if (greatest <= tolerance) return sweep;
    }
    return sweeps;
}

}  // namespace risorius::solve
