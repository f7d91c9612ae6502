#include "muscle/curve.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace risorius::muscle {

namespace {

using Form = CurvePiece::Form;

double value_of(const CurvePiece& p, double u) {
    switch (p.form) {
        case Form::kCubic:
            return p.c0 + u * (p.c1 + u * (p.c2 + u * p.c3));
        case Form::kExponential:
            return p.c0 + p.c1 * u + p.c2 * std::expm1(p.k * u);
        case Form::kHyperbola:
            return p.c0 + p.c1 * u + p.c2 / (1 + p.k * u);
    }
    return 0;
}

double slope_of(const CurvePiece& p, double u) {
    switch (p.form) {
        case Form::kCubic:
            return p.c1 + u * (2 * p.c2 + u * 3 * p.c3);
        case Form::kExponential:
            return p.c1 + p.c2 * p.k * std::exp(p.k * u);
        case Form::kHyperbola: {
            const double d = 1 + p.k * u;
            return p.c1 - p.c2 * p.k / (d * d);
        }
    }
    return 0;
}

/// From the origin of the piece.
double integral_of(const CurvePiece& p, double u) {
    const double line = u * (p.c0 + u * p.c1 / 2);
    switch (p.form) {
        case Form::kCubic:
            return line + u * u * u * (p.c2 / 3 + u * p.c3 / 4);
        case Form::kExponential:
            return line + p.c2 * (std::expm1(p.k * u) / p.k - u);
        case Form::kHyperbola:
            return line + p.c2 * std::log1p(p.k * u) / p.k;
    }
    return 0;
}

}  // namespace

CurvePiece hermite_piece(double x0, double f0, double s0, double x1, double f1, double s1) {
    const double h = x1 - x0;
    const double chord = (f1 - f0) / h;
    return {.end = x1,
            .origin = x0,
            .form = Form::kCubic,
            .c0 = f0,
            .c1 = s0,
            .c2 = (3 * chord - 2 * s0 - s1) / h,
            .c3 = (s0 + s1 - 2 * chord) / (h * h)};
}

CurvePiece line_piece(double x, double f, double slope, double end) {
    return {.end = end, .origin = x, .form = Form::kCubic, .c0 = f, .c1 = slope};
}

CurvePiece toe_piece(double x0, double x1, double height, double k) {
    const double scale = height / (std::expm1(k) - k);
    const double rate = k / (x1 - x0);
    return {.end = x1,
            .origin = x0,
            .form = Form::kExponential,
            .c1 = -scale * rate,
            .c2 = scale,
            .k = rate};
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
    return {value_of(p, u), slope_of(p, u), integral_at_origin_[i] + integral_of(p, u)};
}

std::vector<double> Curve::joints() const {
    std::vector<double> joints;
    for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) joints.push_back(pieces_[i].end);
    return joints;
}

}  // namespace risorius::muscle
