// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/hill_shape.h"

#include <cmath>
#include <numbers>

#include "risorius/muscle/muscle_curves.h"

namespace risorius::muscle {

Curve active_curve(const HillShape& shape) {
    if (shape.zajac) return zajac_curves().active;
    return Curve(
        {{.origin = 1, .form = CurvePiece::Form::kGaussian, .c2 = 1, .k = 1 / shape.active_width}},
        1);
}

Curve passive_curve(const HillShape& shape) {
    if (shape.zajac) return zajac_curves({.passive_strain = shape.passive_strain}).passive;
    const double k = shape.passive_exponent;
    const double scale = 1 / std::expm1(k), rate = k / shape.passive_strain;
    const double knee = 1 + shape.passive_linear * shape.passive_strain;
    return Curve(
        {line_piece(1, 0, 0, 1),
         {.end = knee, .origin = 1, .form = CurvePiece::Form::kExponential, .c2 = scale, .k = rate},
         line_piece(knee, scale * std::expm1(k * shape.passive_linear),
                    scale * rate * std::exp(k * shape.passive_linear))},
        1);
}

LengthCurves::LengthCurves(const HillShape& shape)
    : inverse_width_(1.0 / shape.active_width),
      width_integral_(0.5 * shape.active_width / std::numbers::inv_sqrtpi),
      inverse_strain_(1.0 / shape.passive_strain),
      exponent_(shape.passive_exponent),
      inverse_exponent_(1.0 / shape.passive_exponent),
      knee_(shape.passive_linear),
      inverse_full_(1.0 / std::expm1(shape.passive_exponent)),
      strain_over_full_(shape.passive_strain * inverse_full_) {
    if (shape.zajac) published_ = {active_curve(shape), passive_curve(shape)};
}

LengthCurves::Value LengthCurves::active(double l) const {
    if (!published_.empty()) {
        const Curve::Value at = published_[0].at(l);
        return {at.value, at.integral};
    }
    const double u = (l - 1.0) * inverse_width_;
    return {std::exp(-u * u), width_integral_ * std::erf(u)};
}

double LengthCurves::active_slope(double l) const {
    if (!published_.empty()) return published_[0].at(l).slope;
    const double u = (l - 1.0) * inverse_width_;
    return -2.0 * u * inverse_width_ * std::exp(-u * u);
}

double LengthCurves::passive_slope(double l) const {
    if (!published_.empty()) return published_[1].at(l).slope;
    if (l <= 1.0) return 0.0;
    const double toe = std::fmin((l - 1.0) * inverse_strain_, knee_);
    return exponent_ * inverse_strain_ * std::exp(exponent_ * toe) * inverse_full_;
}

LengthCurves::Value LengthCurves::passive(double l) const {
    if (!published_.empty()) {
        const Curve::Value at = published_[1].at(l);
        return {at.value, at.integral};
    }
    if (l <= 1.0) return {0.0, 0.0};
    const double e = (l - 1.0) * inverse_strain_;
    const double toe = std::fmin(e, knee_);
    const double grown = std::expm1(exponent_ * toe);
    Value value{grown, grown * inverse_exponent_ - toe};
    const double beyond = e - toe;
    if (beyond > 0) {
        const double slope = exponent_ * (grown + 1.0);
        value.force += slope * beyond;
        value.integral += (grown + 0.5 * slope * beyond) * beyond;
    }
    return {value.force * inverse_full_, value.integral * strain_over_full_};
}

}  // namespace risorius::muscle
