// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/hill_branch.h"

namespace risorius::muscle {

namespace {

// Faster shortening than kLeavesAt leaves Hill's hyperbola. It reaches zero force, with zero slope, at kZeroAt.
constexpr double kLeavesAt = -0.9;
constexpr double kZeroAt = -1.1;

}  // namespace

std::vector<CurvePiece> hill_branch(double a) {
    const double value = (1 + kLeavesAt) / (1 - kLeavesAt / a);
    const double slope = (1 + 1 / a) / ((1 - kLeavesAt / a) * (1 - kLeavesAt / a));
    // Hill's (1 + v) / (1 - v / a) = -a + a (1 + a) / (a - v), relative to kLeavesAt.
    const double reach = a - kLeavesAt;
    const CurvePiece shortening = {.end = 0,
                                   .origin = kLeavesAt,
                                   .form = CurvePiece::Form::kHyperbola,
                                   .c0 = -a,
                                   .c2 = a * (1 + a) / reach,
                                   .k = -1 / reach};
    return {line_piece(kZeroAt, 0, 0, kZeroAt),
            hermite_piece(kZeroAt, 0, 0, kLeavesAt, value, slope), shortening};
}

CurvePiece lengthening_piece(double max, double rate) {
    return {.form = CurvePiece::Form::kHyperbola, .c0 = max, .c2 = -(max - 1), .k = rate};
}

}  // namespace risorius::muscle
