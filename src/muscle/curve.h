// A function of one number in closed-form pieces, with its slope and its integral: what the force curves of muscle and
// tendon are made of. The integral is exact, because the line search of a solver needs an energy that agrees with its
// forces.
//
//   u = x - origin of the piece
//   cubic         c0 + c1 u + c2 u^2 + c3 u^3
//   exponential   c0 + c1 u + c2 (e^{k u} - 1)
//   hyperbola     c0 + c1 u + c2 / (1 + k u)
#pragma once

#include <limits>
#include <vector>

namespace risorius::muscle {

struct CurvePiece {
    enum class Form { kCubic, kExponential, kHyperbola };

    double end = std::numeric_limits<double>::infinity();  ///< it holds up to here
    double origin = 0;
    Form form = Form::kCubic;
    double c0 = 0, c1 = 0, c2 = 0, c3 = 0;
    double k = 0;
};

/// From (x0, f0) with slope s0 to (x1, f1) with slope s1.
CurvePiece hermite_piece(double x0, double f0, double s0, double x1, double f1, double s1);
/// Through (x, f); it holds up to `end`.
CurvePiece line_piece(double x, double f, double slope,
                      double end = std::numeric_limits<double>::infinity());
/// From (x0, 0) with slope 0 to (x1, height): height (e^{k s} - 1 - k s) / (e^k - 1 - k), s = (x - x0) / (x1 - x0).
CurvePiece toe_piece(double x0, double x1, double height, double k);

class Curve {
  public:
    struct Value {
        double value = 0, slope = 0, integral = 0;
    };

    /// The pieces from left to right; the first also holds to the left of its origin and the last without end. The
    /// integral is zero at `zero`. Throws std::invalid_argument unless the ends grow and the last is infinite.
    Curve(std::vector<CurvePiece> pieces, double zero);

    double value(double x) const;
    Value at(double x) const;

    /// Where pieces meet.
    std::vector<double> joints() const;

  private:
    std::size_t piece_of(double x) const;

    std::vector<CurvePiece> pieces_;
    std::vector<double> integral_at_origin_;
};

}  // namespace risorius::muscle
