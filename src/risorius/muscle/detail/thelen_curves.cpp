// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/thelen_curves.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "risorius/muscle/detail/hill_branch.h"

namespace risorius::muscle {

namespace {

/// 0 up to x0, then height (e^{k s} - 1) / (e^k - 1) with s = (x - x0) / (x1 - x0), and straight from (x1, height) on. The
/// first 1/k of the exponential is replaced by a cubic.
Curve exponential_curve(double x0, double x1, double height, double k) {
    const double scale = height / std::expm1(k);
    const double rate = k / (x1 - x0);
    const double joins = x0 + 1 / rate;
    return Curve(
        {line_piece(x0, 0, 0, x0),
         hermite_piece(x0, 0, 0, joins, scale * std::expm1(1.0), scale * rate * std::exp(1.0)),
         {.end = x1, .origin = x0, .form = CurvePiece::Form::kExponential, .c2 = scale, .k = rate},
         line_piece(x1, height, scale * rate * std::exp(k))},
        x0);
}

Curve bell_curve(double width) {
    return Curve(
        {{.origin = 1, .form = CurvePiece::Form::kGaussian, .c2 = 1, .k = 1 / std::sqrt(width)}},
        1.0);
}

Curve kinkless_velocity_curve(double a, double max) {
    std::vector<CurvePiece> pieces = hill_branch(a);
    const double rate = 2 * (1 + 1 / a) / (max - 1);
    const double joins = 1 / rate;  // half of the gain and a quarter of the slope are left here
    pieces.push_back(
        hermite_piece(0, 1, 1 + 1 / a, joins, 0.5 * (1 + max), 0.25 * (max - 1) * rate));
    pieces.push_back(lengthening_piece(max, rate));
    return Curve(std::move(pieces), 0);
}

Curve toed_tendon_curve(double strain, double toe_force, double k) {
    // The straight part after the toe passes through (strain, 1).
    // Times the strain at the end of the toe.
    const double end_slope = toe_force * k * std::exp(k) / std::expm1(k);
    return exponential_curve(0, strain / (1 + (1 - toe_force) / end_slope), toe_force, k);
}

void require_within(double value, double above, double below, const char* what) {
    if (!(value > above && value < below))
        throw std::invalid_argument(std::string("thelen_curves: ") + what);
}

}  // namespace

MuscleCurves thelen_curves(const ThelenShape& shape) {
    require_within(shape.active_width, 0, INFINITY, "active_width > 0");
    require_within(shape.passive_strain, 0, INFINITY, "passive_strain > 0");
    require_within(shape.passive_exponent, 1, INFINITY, "passive_exponent > 1");
    require_within(shape.hill_curvature, 0, INFINITY, "hill_curvature > 0");
    require_within(shape.lengthening_force, 1, INFINITY, "lengthening_force > 1");
    require_within(shape.tendon_strain, 0, INFINITY, "tendon_strain > 0");
    require_within(shape.tendon_toe_force, 0, 1, "tendon_toe_force in (0, 1)");
    require_within(shape.tendon_toe_exponent, 1, INFINITY, "tendon_toe_exponent > 1");
    return {
        bell_curve(shape.active_width),
        exponential_curve(1, 1 + shape.passive_strain, 1, shape.passive_exponent),
        kinkless_velocity_curve(shape.hill_curvature, shape.lengthening_force),
        toed_tendon_curve(shape.tendon_strain, shape.tendon_toe_force, shape.tendon_toe_exponent)};
}

}  // namespace risorius::muscle
