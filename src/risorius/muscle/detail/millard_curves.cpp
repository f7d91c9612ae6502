// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/millard_curves.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace risorius::muscle {

namespace {

/// Builds a curve from points with slopes; corners join them.
class CornerChain {
  public:
    CornerChain(double x, double f, double slope) : x_(x), f_(f), slope_(slope) {
        pieces_.push_back(line_piece(x, f, slope, x));
    }
    CornerChain& to(double x, double f, double slope, double curviness) {
        // Millard's curviness avoids both extremes.
        pieces_.push_back(corner_piece(x_, f_, slope_, x, f, slope, 0.1 + 0.8 * curviness));
        x_ = x, f_ = f, slope_ = slope;
        return *this;
    }
    Curve straight_on(double zero) {
        pieces_.push_back(line_piece(x_, f_, slope_));
        return Curve(std::move(pieces_), zero);
    }

  private:
    std::vector<CurvePiece> pieces_;
    double x_, f_, slope_;
};

Curve limbs_curve(const MillardShape& s) {
    constexpr double kShoulder = 0.05;  // half the width of the plateau around l = 1
    constexpr double kRound = 1;
    const double first = s.active_shortest, steep_end = s.active_transition,
                 last = s.active_longest;
    const double plateau_begin = 1 - kShoulder, plateau_end = 1 + kShoulder;
    const double shallow_force = 1 - s.active_shallow_slope * (plateau_begin - steep_end);
    return CornerChain(first, s.active_minimum, 0)
        .to(0.5 * (first + steep_end), 0.5 * shallow_force,
            1.25 * shallow_force / (steep_end - first), kRound)
        .to(0.5 * (steep_end + plateau_begin), 0.5 * (shallow_force + 1), s.active_shallow_slope,
            kRound)
        .to(1, 1, 0, kRound)
        .to(0.5 * (plateau_end + last), 0.5, -1 / (last - kShoulder - plateau_end), kRound)
        .to(last, s.active_minimum, 0, kRound)
        .straight_on(1);
}

Curve parallel_curve(const MillardShape& s) {
    const double stiffness = s.passive_steepness / s.passive_strain;
    const double start = 0.1 * std::min(1 / stiffness, s.passive_strain);
    return CornerChain(1, 0, 0)
        .to(1 + start, s.passive_low_stiffness * 0.5 * start, s.passive_low_stiffness,
            s.passive_curviness)
        .to(1 + s.passive_strain, 1, stiffness, s.passive_curviness)
        .straight_on(1);
}

Curve velocity_corners(const MillardShape& s) {
    constexpr double kNear = 0.1;  // distance from v = -1 and from v = 1
    return CornerChain(-1, 0, 0)
        .to(-1 + kNear, 0.5 * s.shortening_end_slope * kNear, s.shortening_end_slope,
            s.shortening_curviness)
        .to(0, 1, s.isometric_slope, s.shortening_curviness)
        .to(1 - kNear, s.lengthening_force - 0.5 * s.lengthening_end_slope * kNear,
            s.lengthening_end_slope, s.lengthening_curviness)
        .to(1, s.lengthening_force, 0, s.lengthening_curviness)
        .straight_on(0);
}

Curve series_curve(const MillardShape& s) {
    const double stiffness = s.tendon_steepness / s.tendon_strain;
    const auto on_line = [&](double force) { return s.tendon_strain - (1 - force) / stiffness; };
    const double toe_force = s.tendon_toe_force, toe = on_line(toe_force);
    const double foot = toe / 10;  // where the first line of the toe would meet f = 0
    const double middle = on_line(toe_force / 2);
    const double slope = 0.5 * toe_force / (middle - foot);
    return CornerChain(0, 0, 0)
        .to(0.5 * (foot + middle), slope * 0.5 * (middle - foot), slope, s.tendon_curviness)
        .to(toe, toe_force, stiffness, s.tendon_curviness)
        .straight_on(0);
}

void demand(bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("millard_curves: ") + what);
}

bool is_curviness(double c) { return c >= 0 && c <= 1; }

}  // namespace

MuscleCurves millard_curves(const MillardShape& s) {
    demand(s.active_shortest > 0 && s.active_transition > s.active_shortest &&
               s.active_transition < 0.95 && s.active_longest > 1.05 + 0.05,
           "0 < active_shortest < active_transition < 0.95 and active_longest > 1.1");
    demand(s.active_minimum >= 0 && s.active_minimum < 1, "active_minimum in [0, 1)");
    demand(s.active_shallow_slope > 0 &&
               s.active_shallow_slope < (1 - s.active_minimum) / (1 - s.active_transition),
           "active_shallow_slope in (0, (1 - active_minimum) / (1 - active_transition))");
    demand(s.passive_strain > 0, "passive_strain > 0");
    demand(s.passive_low_stiffness > 0 && s.passive_low_stiffness * s.passive_strain < 1,
           "passive_low_stiffness in (0, 1 / passive_strain)");
    demand(s.passive_steepness > 1, "passive_steepness > 1");
    demand(s.shortening_end_slope > 0 && s.shortening_end_slope <= 1,
           "shortening_end_slope in (0, 1]");
    demand(s.isometric_slope > 1, "isometric_slope > 1");
    demand(s.lengthening_force > 1, "lengthening_force > 1");
    demand(s.lengthening_end_slope > 0 && s.lengthening_end_slope < s.lengthening_force - 1,
           "lengthening_end_slope in (0, lengthening_force - 1)");
    demand(s.tendon_strain > 0, "tendon_strain > 0");
    demand(s.tendon_steepness > 1, "tendon_steepness > 1");
    demand(s.tendon_toe_force > 0 && s.tendon_toe_force < 1, "tendon_toe_force in (0, 1)");
    demand(is_curviness(s.passive_curviness) && is_curviness(s.shortening_curviness) &&
               is_curviness(s.lengthening_curviness) && is_curviness(s.tendon_curviness),
           "curviness in [0, 1]");
    return {limbs_curve(s), parallel_curve(s), velocity_corners(s), series_curve(s)};
}

}  // namespace risorius::muscle
