// SPDX-License-Identifier: MIT
/// \file
/// The active and passive force-length curves of the fibres of a face, dimensionless.
///
///   l   fibre length / optimal fibre length              l > 0
///   f   force / maximum isometric force
///
///   active    e^{-((l - 1) / width)^2}
///   passive   (e^{k (l - 1) / e0} - 1) / (e^k - 1) from l = 1 on; straight beyond l = 1 + linear e0, so that a
///             trial step that is too long cannot overflow
///
/// width, e0, k and linear are the fields of HillShape. The forms are those of D. G. Thelen 2003, J. Biomech. Eng. 125(1),
/// 70-77; the numbers are those of resting facial muscle. `active_width` is the width itself here, but its square (gamma) in
/// ThelenShape: Thelen's curve e^{-(l - 1)^2 / 0.45} has the width 0.67. The passive curve has a kink at l = 1, where its slope
/// jumps from 0 to 0.11. It is not smoothed, because the muscle strengths of rigs are calibrated with it.
///
/// The inner loop of FibreSet uses LengthCurves instead of Curve. Both give the same numbers up to rounding, but a Curve
/// searches for its piece and computes a slope that the loop does not need. For both forces and their integrals, Curve takes 84
/// ns and LengthCurves 30 ns.
#pragma once

#include <vector>

#include "risorius/muscle/detail/curve.h"

namespace risorius::muscle {

/// The numbers of the force-length curves of a fibre of the face.
struct HillShape {
    double active_width = 0.45;     ///< width                                     (0, inf)
    double passive_strain = 0.7;    ///< strain at which passive f is 1           (0, inf)
    double passive_exponent = 4.0;  ///< steepness of the passive curve           (0, inf)
    double passive_linear = 1.5;    ///< straight beyond this times passive_strain   (0, inf)
    /// The set of curves of the volume muscles, Zajac's with the given passive strain, in place of all this (muscle_curves.h)
    bool zajac = false;
};

Curve active_curve(const HillShape& shape);   ///< active force-length curve; integral 0 at l = 1
Curve passive_curve(const HillShape& shape);  ///< passive force-length curve; integral 0 at l = 1

/// Value and integral of both force-length curves, with precomputed constants.
class LengthCurves {
  public:
    struct Value {
        double force;
        double integral;
    };
    explicit LengthCurves(const HillShape& shape);
    Value active(double l) const;
    Value passive(double l) const;
    double active_slope(double l) const;   ///< slope of the active force
    double passive_slope(double l) const;  ///< slope of the passive force

  private:
    std::vector<Curve> published_;  ///< active and passive; empty for the forms of this file
    double inverse_width_, width_integral_;
    double inverse_strain_, exponent_, inverse_exponent_, knee_, inverse_full_, strain_over_full_;
};

}  // namespace risorius::muscle
