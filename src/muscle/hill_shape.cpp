#include "muscle/hill_shape.h"

#include <cmath>
#include <numbers>

namespace risorius::muscle {

namespace {

// Shortening faster than kFadeBegin leaves Hill's hyperbola and reaches zero force, with zero
// slope, at kFadeEnd.
constexpr double kFadeBegin = -0.9;
constexpr double kFadeEnd = -1.1;
constexpr double kFadeWidth = kFadeBegin - kFadeEnd;

double hyperbola(double v, double a) { return (1.0 + v) / (1.0 - v / a); }
double hyperbola_slope(double v, double a) {
    const double d = 1.0 - v / a;
    return (1.0 + 1.0 / a) / (d * d);
}
double hyperbola_integral(double v, double a) {
    return -a * (1.0 + a) * std::log1p(-v / a) - a * v;
}

/// Cubic from (t=0: 0, slope 0) to (t=1: value, slope), t = (v - kFadeEnd) / kFadeWidth, and its
/// integral from t = 0.
struct Fade {
    double value;
    double slope;  ///< per unit of t
    double at(double t) const { return t * t * ((3 - 2 * t) * value + (t - 1) * slope); }
    double slope_at(double t) const {
        return 6 * t * (1 - t) * value + (3 * t * t - 2 * t) * slope;
    }
    double integral_to(double t) const {
        const double t3 = t * t * t;
        return kFadeWidth * (t3 * (1 - t / 2) * value + t3 * (t / 4 - 1.0 / 3.0) * slope);
    }
};

Fade fade(double a) {
    return {hyperbola(kFadeBegin, a), kFadeWidth * hyperbola_slope(kFadeBegin, a)};
}

double lengthening_rate(const HillShape& s) {
    return (1.0 + 1.0 / s.velocity_curvature) / (s.lengthening_force - 1.0);
}

}  // namespace

double active_force(double l, const HillShape& shape) {
    const double u = (l - 1.0) / shape.active_width;
    return std::exp(-u * u);
}

double active_force_slope(double l, const HillShape& shape) {
    const double u = (l - 1.0) / shape.active_width;
    return -2.0 * u / shape.active_width * std::exp(-u * u);
}

double active_force_integral(double l, const HillShape& shape) {
    const double half_root_pi = 0.5 / std::numbers::inv_sqrtpi;
    return shape.active_width * half_root_pi * std::erf((l - 1.0) / shape.active_width);
}

double passive_force(double l, const HillShape& shape) {
    // A slack fibre buckles rather than pushes, so the curve ends at its rest length.
    if (l <= 1.0) return 0.0;
    const double k = shape.passive_exponent;
    const double e = (l - 1.0) / shape.passive_strain;
    const double knee = shape.passive_linear;
    if (e <= knee) return std::expm1(k * e) / std::expm1(k);
    return (std::expm1(k * knee) + k * std::exp(k * knee) * (e - knee)) / std::expm1(k);
}

double passive_force_slope(double l, const HillShape& shape) {
    if (l <= 1.0) return 0.0;
    const double k = shape.passive_exponent;
    const double e = std::fmin((l - 1.0) / shape.passive_strain, shape.passive_linear);
    return k * std::exp(k * e) / (std::expm1(k) * shape.passive_strain);
}

double passive_force_integral(double l, const HillShape& shape) {
    if (l <= 1.0) return 0.0;
    const double k = shape.passive_exponent;
    const double e = (l - 1.0) / shape.passive_strain;
    const double toe = std::fmin(e, shape.passive_linear);
    const double scale = shape.passive_strain / std::expm1(k);
    double sum = std::expm1(k * toe) / k - toe;
    const double beyond = e - toe;
    if (beyond > 0)
        sum += std::expm1(k * toe) * beyond + 0.5 * k * std::exp(k * toe) * beyond * beyond;
    return scale * sum;
}

double velocity_force(double v, const HillShape& shape) {
    const double a = shape.velocity_curvature;
    if (v <= kFadeEnd) return 0.0;
    if (v < kFadeBegin) return fade(a).at((v - kFadeEnd) / kFadeWidth);
    if (v <= 0) return hyperbola(v, a);
    const double most = shape.lengthening_force;
    return most - (most - 1.0) / (1.0 + lengthening_rate(shape) * v);
}

double velocity_force_slope(double v, const HillShape& shape) {
    const double a = shape.velocity_curvature;
    if (v <= kFadeEnd) return 0.0;
    if (v < kFadeBegin) return fade(a).slope_at((v - kFadeEnd) / kFadeWidth) / kFadeWidth;
    if (v <= 0) return hyperbola_slope(v, a);
    const double k = lengthening_rate(shape);
    const double d = 1.0 + k * v;
    return (shape.lengthening_force - 1.0) * k / (d * d);
}

double velocity_force_integral(double v, const HillShape& shape) {
    const double a = shape.velocity_curvature;
    if (v < kFadeBegin) {
        const Fade curve = fade(a);
        const double t = std::fmax(0.0, (v - kFadeEnd) / kFadeWidth);
        return hyperbola_integral(kFadeBegin, a) - curve.integral_to(1.0) + curve.integral_to(t);
    }
    if (v <= 0) return hyperbola_integral(v, a);
    const double k = lengthening_rate(shape);
    const double most = shape.lengthening_force;
    return most * v - (most - 1.0) / k * std::log1p(k * v);
}

}  // namespace risorius::muscle
