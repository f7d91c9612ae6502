// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace risorius::muscle {

namespace {

using CurveForm = CurvePiece::Form;

/// Sum of p[j] s^(j+1): one coordinate of a corner, relative to its start.
struct Quintic {
    std::array<double, 5> p;

    /// `near` and `far` are the doubled points.
    Quintic(double near, double far, double end)
        : p{5 * near, -10 * near, 10 * far, 10 * near - 15 * far, end + 5 * (far - near)} {}

    double at(double s) const {
        return s * (p[0] + s * (p[1] + s * (p[2] + s * (p[3] + s * p[4]))));
    }
    double slope(double s) const {
        return p[0] + s * (2 * p[1] + s * (3 * p[2] + s * (4 * p[3] + s * 5 * p[4])));
    }
};

struct Corner {
    Quintic x, y;
    double length;

    explicit Corner(const CurvePiece& piece)
        : x(piece.k * piece.c2, (1 - piece.k) * (piece.end - piece.origin) + piece.k * piece.c2,
            piece.end - piece.origin),
          y(piece.k * (piece.c3 - piece.c0),
            (1 - piece.k) * (piece.c1 - piece.c0) + piece.k * (piece.c3 - piece.c0),
            piece.c1 - piece.c0),
          length(piece.end - piece.origin) {}

    /// The s with x(s) = u. x grows everywhere, so the root is always between `low` and `high`.
    double parameter(double u) const {
        if (u <= 0) return 0;
        if (u >= length) return 1;
        double low = 0, high = 1, s = u / length;
        for (int i = 0; i < 60; ++i) {  // about six are needed; bisection alone would end here too
            const double miss = x.at(s) - u;
            (miss > 0 ? high : low) = s;
            const double slope = x.slope(s);
            const double newton = slope > 0 ? s - miss / slope : low;
            if (slope > 0 && std::abs(newton - s) <= 4e-16) return std::clamp(newton, 0.0, 1.0);
            s = newton > low && newton < high ? newton : 0.5 * (low + high);
        }
        return s;
    }
    double slope(double s) const { return y.slope(s) / x.slope(s); }
    /// Integral of y - y(0) by x.
    double integral(double s) const {
        double sum = 0;
        for (int power = 10; power >= 2; --power) {
            double factor = 0;  // coefficient of s^power
            for (int j = std::max(1, power - 5); j <= std::min(5, power - 1); ++j)
                factor += y.p[static_cast<std::size_t>(power - j - 1)] * j *
                          x.p[static_cast<std::size_t>(j - 1)];
            sum = sum * s + factor / power;
        }
        return sum * s * s;
    }
};

double value_of(const CurvePiece& p, double u) {
    switch (p.form) {
        case CurveForm::kCubic:
            return p.c0 + u * (p.c1 + u * (p.c2 + u * p.c3));
        case CurveForm::kExponential:
            return p.c0 + p.c1 * u + p.c2 * std::expm1(p.k * u);
        case CurveForm::kHyperbola:
            return p.c0 + p.c1 * u + p.c2 / (1 + p.k * u);
        case CurveForm::kGaussian:
            return p.c0 + p.c1 * u + p.c2 * std::exp(-(p.k * u) * (p.k * u));
        case CurveForm::kCorner: {
            const Corner corner(p);
            return p.c0 + corner.y.at(corner.parameter(u));
        }
    }
    return 0;
}

double slope_of(const CurvePiece& p, double u) {
    switch (p.form) {
        case CurveForm::kCubic:
            return p.c1 + u * (2 * p.c2 + u * 3 * p.c3);
        case CurveForm::kExponential:
            return p.c1 + p.c2 * p.k * std::exp(p.k * u);
        case CurveForm::kHyperbola: {
            const double d = 1 + p.k * u;
            return p.c1 - p.c2 * p.k / (d * d);
        }
        case CurveForm::kGaussian:
            return p.c1 - 2 * p.c2 * p.k * (p.k * u) * std::exp(-(p.k * u) * (p.k * u));
        case CurveForm::kCorner:
            break;  // handled by corner_at
    }
    return 0;
}

/// Integral from the origin of the piece.
double integral_of(const CurvePiece& p, double u) {
    const double line = u * (p.c0 + u * p.c1 / 2);
    switch (p.form) {
        case CurveForm::kCubic:
            return line + u * u * u * (p.c2 / 3 + u * p.c3 / 4);
        case CurveForm::kExponential:
            return line + p.c2 * (std::expm1(p.k * u) / p.k - u);
        case CurveForm::kHyperbola:
            return line + p.c2 * std::log1p(p.k * u) / p.k;
        case CurveForm::kGaussian:
            return line + p.c2 * std::erf(p.k * u) / (p.k * 2 * std::numbers::inv_sqrtpi);
        case CurveForm::kCorner:
            return u * p.c0 + Corner(p).integral(Corner(p).parameter(u));
    }
    return 0;
}

/// Value, slope and integral with one search for s.
Curve::Value corner_at(const CurvePiece& p, double u) {
    const Corner corner(p);
    const double s = corner.parameter(u);
    return {p.c0 + corner.y.at(s), corner.slope(s), u * p.c0 + corner.integral(s)};
}

}  // namespace

CurvePiece hermite_piece(double x0, double f0, double s0, double x1, double f1, double s1) {
    const double h = x1 - x0;
    const double chord = (f1 - f0) / h;
    return {.end = x1,
            .origin = x0,
            .form = CurveForm::kCubic,
            .c0 = f0,
            .c1 = s0,
            .c2 = (3 * chord - 2 * s0 - s1) / h,
            .c3 = (s0 + s1 - 2 * chord) / (h * h)};
}

CurvePiece line_piece(double x, double f, double slope, double end) {
    return {.end = end, .origin = x, .form = CurveForm::kCubic, .c0 = f, .c1 = slope};
}

CurvePiece toe_piece(double x0, double x1, double height, double k) {
    const double scale = height / (std::expm1(k) - k);
    const double rate = k / (x1 - x0);
    return {.end = x1,
            .origin = x0,
            .form = CurveForm::kExponential,
            .c1 = -scale * rate,
            .c2 = scale,
            .k = rate};
}

CurvePiece corner_piece(double x0, double f0, double s0, double x1, double f1, double s1,
                        double roundness) {
    // The place where the lines f0 + s0 u and f1 + s1 (u - h) meet.
    const double h = x1 - x0;
    const double corner = s0 == s1 ? h / 2 : (f1 - f0 - s1 * h) / (s0 - s1);
    if (!(corner > 0 && corner < h && roundness > 0 && roundness < 1))
        throw std::invalid_argument(
            "corner_piece: the lines through the ends have to meet between them");
    return {.end = x1,
            .origin = x0,
            .form = CurveForm::kCorner,
            .c0 = f0,
            .c1 = f1,
            .c2 = corner,
            .c3 = f0 + s0 * corner,
            .k = roundness};
}

Curve::Curve(std::vector<CurvePiece> pieces, double zero) : pieces_(std::move(pieces)) {
    if (pieces_.empty() || !std::isinf(pieces_.back().end))
        throw std::invalid_argument("Curve: the last piece has to be without end");
    for (std::size_t i = 0; i + 1 < pieces_.size(); ++i)
        if (!(pieces_[i].end < pieces_[i + 1].end))
            throw std::invalid_argument("Curve: pieces have to follow each other");

    integral_at_origin_.resize(pieces_.size());
    double sum = 0;  // up to the left end of the piece
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const CurvePiece& p = pieces_[i];
        const double begin = i == 0 ? p.origin : pieces_[i - 1].end;
        integral_at_origin_[i] = sum - integral_of(p, begin - p.origin);
        if (i + 1 < pieces_.size()) sum = integral_at_origin_[i] + integral_of(p, p.end - p.origin);
    }
    const double shift = at(zero).integral;
    for (double& integral : integral_at_origin_) integral -= shift;
}

std::size_t Curve::piece_of(double x) const {
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && x >= pieces_[i].end) ++i;
    return i;
}

double Curve::value(double x) const {
    const CurvePiece& p = pieces_[piece_of(x)];
    return value_of(p, x - p.origin);
}

Curve::Value Curve::at(double x) const {
    const std::size_t i = piece_of(x);
    const CurvePiece& p = pieces_[i];
    const double u = x - p.origin;
    if (p.form == CurveForm::kCorner) {
        const Value v = corner_at(p, u);
        return {v.value, v.slope, integral_at_origin_[i] + v.integral};
    }
    return {value_of(p, u), slope_of(p, u), integral_at_origin_[i] + integral_of(p, u)};
}

std::vector<double> Curve::joints() const {
    std::vector<double> joints;
    for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) joints.push_back(pieces_[i].end);
    return joints;
}

}  // namespace risorius::muscle
