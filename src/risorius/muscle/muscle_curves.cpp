// SPDX-License-Identifier: MIT
#include "risorius/muscle/muscle_curves.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "risorius/muscle/detail/hill_branch.h"

namespace risorius::muscle {

namespace {

void require(bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("zajac_curves: ") + what);
}

Curve active_curve(const std::vector<std::pair<double, double>>& points) {
    require(points.size() >= 3, "three active_points or more");
    const std::size_t n = points.size();
    std::size_t peak = 0;
    for (std::size_t i = 0; i < n; ++i) {
        require(std::isfinite(points[i].first) && points[i].second >= 0, "active_points >= 0");
        require(i == 0 || points[i].first > points[i - 1].first, "active_points of growing length");
        if (points[i].second > points[peak].second) peak = i;
    }
    require(peak > 0 && peak + 1 < n, "the peak of active_points between their ends");

    std::vector<double> slope(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i)
        if (i != peak)
            slope[i] = (points[i + 1].second - points[i - 1].second) /
                       (points[i + 1].first - points[i - 1].first);
    std::vector<CurvePiece> pieces = {
        line_piece(points[0].first, points[0].second, 0, points[0].first)};
    for (std::size_t i = 0; i + 1 < n; ++i)
        pieces.push_back(hermite_piece(points[i].first, points[i].second, slope[i],
                                       points[i + 1].first, points[i + 1].second, slope[i + 1]));
    pieces.push_back(line_piece(points[n - 1].first, points[n - 1].second, 0));
    return Curve(std::move(pieces), 1.0);
}

/// 0, then a toe up to (x1, height), then straight on with its last slope.
Curve toe_curve(double x0, double x1, double height, double k) {
    const double last_slope = height * k * std::expm1(k) / ((std::expm1(k) - k) * (x1 - x0));
    return Curve({line_piece(x0, 0, 0, x0), toe_piece(x0, x1, height, k),
                  line_piece(x1, height, last_slope)},
                 x0);
}

Curve velocity_curve(double a, double max) {
    std::vector<CurvePiece> pieces = hill_branch(a);
    // The rate that gives both hyperbolas the slope 1 + 1/a at v = 0.
    pieces.push_back(lengthening_piece(max, (1 + 1 / a) / (max - 1)));
    return Curve(std::move(pieces), 0);
}

Curve tendon_curve(double strain, double toe_force, double k) {
    // The straight part has the slope of the toe's end and passes through (strain, 1).
    const double steepness = k * std::expm1(k) / (std::expm1(k) - k);
    const double toe_strain = strain / (1 + (1 - toe_force) / (toe_force * steepness));
    return toe_curve(0, toe_strain, toe_force, k);
}

}  // namespace

MuscleCurves zajac_curves(const ZajacShape& shape) {
    require(shape.passive_strain > 0, "passive_strain > 0");
    require(shape.passive_exponent > 0, "passive_exponent > 0");
    require(shape.hill_curvature > 0, "hill_curvature > 0");
    require(shape.lengthening_force > 1, "lengthening_force > 1");
    require(shape.tendon_strain > 0, "tendon_strain > 0");
    require(shape.tendon_toe_force > 0 && shape.tendon_toe_force < 1, "tendon_toe_force in (0, 1)");
    require(shape.tendon_toe_exponent > 0, "tendon_toe_exponent > 0");
    return {active_curve(shape.active_points),
            toe_curve(1, 1 + shape.passive_strain, 1, shape.passive_exponent),
            velocity_curve(shape.hill_curvature, shape.lengthening_force),
            tendon_curve(shape.tendon_strain, shape.tendon_toe_force, shape.tendon_toe_exponent)};
}

}  // namespace risorius::muscle
