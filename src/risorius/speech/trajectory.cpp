// SPDX-License-Identifier: MIT
#include "risorius/speech/trajectory.h"

#include <algorithm>
#include <cmath>

#include "risorius/solve/bounded_curve.h"

namespace risorius::speech {

namespace {

constexpr double kRamp_s = 0.045;  // in which the lower lip reaches the teeth
// Rounds in which parts that are too fast are slowed down, and how strongly: the weight doubles from round to round.
constexpr int kSpeedRounds = 14;
constexpr double kSpeedMargin = 0.97;
// A curve may leave the range of its targets by this, in its unit.
constexpr double kOvershoot = 0.05;

long index_from(double t_s, double start_s) {
    return static_cast<long>(std::ceil((t_s - start_s) / kCurveStep_s - 1e-9));
}
long index_to(double t_s, double start_s) {
    return static_cast<long>(std::floor((t_s - start_s) / kCurveStep_s + 1e-9));
}

/// Bounds of a curve by the targets around it: between two windows that matter, no value outside of theirs and those of the weak
/// ones between.
void stay_in_range(const std::vector<Window>& windows, double start_s, solve::CurveQuadratic& q) {
    const long n = q.b.size();
    std::vector<const Window*> strong, weak;
    for (const Window& window : windows) (window.weak ? weak : strong).push_back(&window);
    const auto earlier = [](const Window* a, const Window* b) { return a->from_s < b->from_s; };
    std::stable_sort(weak.begin(), weak.end(), earlier);
    for (std::size_t k = 0; k + 1 < strong.size(); ++k) {
        const Window &one = *strong[k], &two = *strong[k + 1];
        double low = std::min(one.target, two.target), high = std::max(one.target, two.target);
        for (auto w = std::lower_bound(weak.begin(), weak.end(), &one, earlier);
             w != weak.end() && (*w)->from_s <= two.to_s; ++w)
            if ((*w)->to_s <= two.to_s) {
                low = std::min(low, (*w)->target);
                high = std::max(high, (*w)->target);
            }
        const long from = std::max(0L, index_from(one.to_s, start_s)),
                   to = std::min(n - 1, index_to(two.from_s, start_s));
        for (long i = from; i <= to; ++i) {
            q.min[i] = std::max(q.min[i], low - kOvershoot);
            q.max[i] = std::min(q.max[i], high + kOvershoot);
        }
    }
}

/// A bound that holds against the range of the targets.
void apply(const Bound& bound, double start_s, solve::CurveQuadratic& q) {
    const long n = q.b.size();
    long from = std::max(0L, index_from(bound.from_s, start_s)),
         to = std::min(n - 1, index_to(bound.to_s, start_s));
    if (from > to) {  // between two grid points: the nearest one
        from = to = std::clamp(
            std::lround(((bound.from_s + bound.to_s) / 2 - start_s) / kCurveStep_s), 0L, n - 1);
    }
    for (long i = from; i <= to; ++i) {
        q.min[i] = std::max(q.min[i], bound.min);
        q.max[i] = std::min(q.max[i], bound.max);
        if (q.min[i] <= q.max[i]) continue;
        // The bound of the phone is physics; that of the range is taste.
        if (std::isfinite(bound.max))
            q.min[i] = q.max[i] = bound.max;
        else
            q.min[i] = q.max[i] = bound.min;
    }
}

/// Adds weight / 2 (x_{i+1} - x_i - step)^2.
void pull_step(solve::CurveQuadratic& q, long i, double step, double weight) {
    q.diagonal[i] += weight;
    q.diagonal[i + 1] += weight;
    q.first[i] -= weight;
    q.b[i] -= weight * step;
    q.b[i + 1] += weight * step;
}

solve::CurveSolution slow_enough(solve::CurveQuadratic q, double speed) {
    solve::CurveSolution out = solve::minimise(q);
    const double step = speed * kCurveStep_s;
    double weight = 0.05 * q.diagonal.maxCoeff();
    for (int round = 0; round < kSpeedRounds; ++round, weight *= 2) {
        bool fast = false;
        for (long i = 0; i + 1 < out.x.size(); ++i) {
            const double moved = out.x[i + 1] - out.x[i];
            if (std::abs(moved) <= step) continue;
            fast = true;
            pull_step(q, i, std::copysign(kSpeedMargin * step, moved), weight);
        }
        if (!fast) break;
        out = solve::minimise(q);
    }
    return out;
}

}  // namespace

ArticulationCurves curves_of(const ArticulationTargets& targets) {
    ArticulationCurves out;
    // Grid points are multiples of the step, so that the sound's first sample is one of them.
    const long first = static_cast<long>(std::floor(targets.start_s / kCurveStep_s)),
               last = static_cast<long>(std::ceil(targets.end_s / kCurveStep_s));
    out.start_s = static_cast<double>(first) * kCurveStep_s;
    const long n = last - first + 1;
    constexpr double h = kCurveStep_s;
    for (std::size_t p = 0; p < kParameterCount; ++p) {
        std::vector<Window> windows;
        for (const Window& window : targets.windows)
            if (static_cast<std::size_t>(window.parameter) == p) windows.push_back(window);
        solve::CurveQuadratic q(n);
        q.bend(1 / (h * h * h));
        for (const Window& window : windows) {
            const double weight = std::pow(window.tau_s, -4) * h;
            const long from = std::max(0L, index_from(window.from_s, out.start_s)),
                       to = std::min(n - 1, index_to(window.to_s, out.start_s));
            // What the window has between its grid points counts as part of one.
            const double inside = std::max(0L, to - from + 1), length = window.to_s - window.from_s;
            if (from <= to) {
                for (long i = from; i <= to; ++i)
                    q.pull(i, window.target, weight * std::max(length / h, 0.2) / inside);
            } else {
                const long i = std::clamp(
                    std::lround(((window.from_s + window.to_s) / 2 - out.start_s) / h), 0L, n - 1);
                q.pull(i, window.target, weight * std::max(length / h, 0.2));
            }
        }
        stay_in_range(windows, out.start_s, q);
        for (const Bound& bound : targets.bounds)
            if (static_cast<std::size_t>(bound.parameter) == p) apply(bound, out.start_s, q);
        const auto parameter = static_cast<Parameter>(p);
        const bool lips = parameter == Parameter::kGap;
        solve::CurveSolution solution =
            lips ? slow_enough(std::move(q), kMaxLipSpeed_mm_s) : solve::minimise(q);
        out.converged = out.converged && solution.converged;
        out.values[p] = std::move(solution.x);
    }
    // The grid points of a time, and one more at each end.
    const auto first_near = [&](double t_s) {
        return std::clamp(index_from(t_s, out.start_s) - 1, 0L, n);
    };
    const auto end_near = [&](double t_s) {
        return std::clamp(index_to(t_s, out.start_s) + 2, 0L, n);
    };
    out.labiodental = Eigen::VectorXd::Zero(n);
    out.bounded = Eigen::VectorXd::Zero(n);
    for (const LabiodentalContact& contact : targets.contacts)
        for (long i = first_near(contact.from_s - kRamp_s), end = end_near(contact.to_s + kRamp_s);
             i < end; ++i) {
            const double t = out.time_s(i);
            const double away = std::max({0.0, contact.from_s - t, t - contact.to_s}) / kRamp_s;
            if (away >= 1) continue;
            const double s = 1 - away, value = contact.strength * s * s * (3 - 2 * s);
            out.labiodental[i] = std::max(out.labiodental[i], value);
            if (away == 0) out.bounded[i] = 1;
        }
    for (const LipClosure& closure : targets.closures)
        for (long i = first_near(closure.closure_s), end = end_near(closure.release_s); i < end;
             ++i)
            if (out.time_s(i) >= closure.closure_s && out.time_s(i) <= closure.release_s)
                out.bounded[i] = 1;
    return out;
}

namespace {

/// Catmull-Rom: a cubic between two grid points, with slopes of central differences. Also its derivative.
std::pair<double, double> cubic(const Eigen::VectorXd& x, double place) {
    const long n = x.size();
    if (n == 0) return {0, 0};
    if (place <= 0) return {x[0], 0};
    if (place >= static_cast<double>(n - 1)) return {x[n - 1], 0};
    const long i = static_cast<long>(place);
    const double s = place - static_cast<double>(i);
    const double a = x[std::max(0L, i - 1)], b = x[i], c = x[i + 1], d = x[std::min(n - 1, i + 2)];
    const double m0 = (c - a) / 2, m1 = (d - b) / 2;
    const double c2 = 3 * (c - b) - 2 * m0 - m1, c3 = 2 * (b - c) + m0 + m1;
    return {b + s * (m0 + s * (c2 + s * c3)), m0 + s * (2 * c2 + s * 3 * c3)};
}

}  // namespace

double ArticulationCurves::at(Parameter p, double t_s) const {
    return cubic(values[static_cast<std::size_t>(p)], (t_s - start_s) / kCurveStep_s).first;
}

double ArticulationCurves::speed_at(Parameter p, double t_s) const {
    return cubic(values[static_cast<std::size_t>(p)], (t_s - start_s) / kCurveStep_s).second /
           kCurveStep_s;
}

double ArticulationCurves::labiodental_at(double t_s) const {
    return std::clamp(cubic(labiodental, (t_s - start_s) / kCurveStep_s).first, 0.0, 1.0);
}

}  // namespace risorius::speech
