// SPDX-License-Identifier: MIT
/// \file
/// A function of one variable in closed-form pieces, with its slope and its integral. The force-length, force-velocity and
/// tendon curves are such functions. The integral is exact, because the line search of a solver needs an energy that agrees
/// with the forces.
///
///   u = x - origin of the piece
///   cubic         c0 + c1 u + c2 u^2 + c3 u^3
///   exponential   c0 + c1 u + c2 (e^{k u} - 1)
///   hyperbola     c0 + c1 u + c2 / (1 + k u)
///   gaussian      c0 + c1 u + c2 e^{-(k u)^2}
///   corner        C2, from one straight line into another: a Bezier curve of fifth order in a parameter s, 0..1. Its points
///                 are (0, c0); twice the point at the fraction k of the way from there to the corner (c2, c3); twice the
///                 point at the fraction k of the way from the end (end - origin, c1) to the corner; and the end. x(s) is
///                 inverted to the last bit by Newton's method; the integral of y dx is a polynomial in s.
///                 Source of the corner: M. Millard et al. 2013, J. Biomech. Eng. 135(2), 021005.
#pragma once

#include <limits>
#include <vector>

namespace risorius::muscle {

/// One piece of a curve, with the symbols of the formulas above.
struct CurvePiece {
    enum class Form { kCubic, kExponential, kHyperbola, kGaussian, kCorner };

    double end = std::numeric_limits<double>::infinity();  ///< upper end of the piece
    double origin = 0;
    Form form = Form::kCubic;
    double c0 = 0, c1 = 0, c2 = 0, c3 = 0;
    double k = 0;
};

/// Cubic from (x0, f0) with slope s0 to (x1, f1) with slope s1.
CurvePiece hermite_piece(double x0, double f0, double s0, double x1, double f1, double s1);
/// Line through (x, f). The piece ends at `end`.
CurvePiece line_piece(double x, double f, double slope,
                      double end = std::numeric_limits<double>::infinity());
/// Exponential from (x0, 0) with slope 0 to (x1, height): height (e^{k s} - 1 - k s) / (e^k - 1 - k), s = (x - x0) / (x1 - x0).
CurvePiece toe_piece(double x0, double x1, double height, double k);
/// Corner from (x0, f0) with slope s0 to (x1, f1) with slope s1, without curvature at the ends. `roundness`, in (0, 1), makes
/// nearly straight lines near 0 and wide arcs near 1. Throws std::invalid_argument when the lines through the ends do not meet
/// between x0 and x1.
CurvePiece corner_piece(double x0, double f0, double s0, double x1, double f1, double s1,
                        double roundness);

/// A curve of pieces.
class Curve {
  public:
    struct Value {
        double value = 0, slope = 0, integral = 0;
    };

    /// The pieces from left to right. The first piece is also used left of its origin, and the last has no end. The integral is
    /// zero at x = `zero`. Throws std::invalid_argument unless the ends ascend and the last one is infinite.
    Curve(std::vector<CurvePiece> pieces, double zero);

    double value(double x) const;
    Value at(double x) const;

    /// The values of x where pieces meet.
    std::vector<double> joints() const;

  private:
    std::size_t piece_of(double x) const;

    std::vector<CurvePiece> pieces_;
    std::vector<double> integral_at_origin_;
};

}  // namespace risorius::muscle
