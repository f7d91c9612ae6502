// SPDX-License-Identifier: MIT
/// \file
/// Interpolation between the last two steps, smooth from one step to the next.
#pragma once

namespace risorius::face {

/// Weights of the last three states. Their sum is 1.
struct StateWeights {
    double earlier = 0, before = 0, now = 1;

    template <typename T>
    T of(const T& e, const T& b, const T& n) const {
        if (earlier == 0) return before * b + now * n;
        return earlier * e + before * b + now * n;
    }
};

/// Weights of a straight line from `before` to `now`. `fraction`: 0 before, 1 now.
inline StateWeights straight(double fraction) { return {0, 1 - fraction, fraction}; }

/// Weights of the cubic Hermite curve from `before` to `now` whose velocity at each state is the difference to the state before it.
/// This velocity is known as soon as the state is, so that the velocity has no jumps from one step to the next. For a constant
/// acceleration a and steps of h, the curve differs from the parabola by at most 0.048 a h^2, and in the middle by 0.
inline StateWeights smooth(double fraction) {
    const double f = fraction, now = f * f * (2 - f), earlier = -f * (1 - f) * (1 - f);
    return {earlier, 1 - now - earlier, now};
}

}  // namespace risorius::face
