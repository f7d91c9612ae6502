// SPDX-License-Identifier: MIT
#include "risorius/solve/quasi_newton.h"

#include <algorithm>
#include <cmath>

#include "risorius/solve/point_sums.h"

namespace risorius::solve {

// direction_ = -H gradient_, where H is the L-BFGS inverse with initial metric A^-1 (Nocedal's two loops).
template <class Real>
void QuasiNewton::direction(const InverseMetric& metric, Ring<Real>& pairs) {
    const int ring = static_cast<int>(pairs.size());
    const auto pair = [&](int age) -> Pair<Real>& {
        return pairs[static_cast<std::size_t>((newest_ - age + ring) % ring)];
    };
    work_ = gradient_;
    double along = kept_ > 0 ? dot(pair(0).step, work_) : 0;
    for (int age = 0; age < kept_; ++age) {
        Pair<Real>& p = pair(age);
        p.alpha = p.inverse_product * along;
        along = age + 1 < kept_
                    ? add_and_dot(work_, -p.alpha, p.gradient_change, pair(age + 1).step)
                    : add_and_dot(work_, -p.alpha, p.gradient_change, work_);
    }
    metric(work_, direction_);
    along = kept_ > 0 ? dot(pair(kept_ - 1).gradient_change, direction_) : 0;
    for (int age = kept_ - 1; age >= 0; --age) {
        const Pair<Real>& p = pair(age);
        const double fraction = p.alpha - p.inverse_product * along;
        along = age > 0 ? add_and_dot(direction_, fraction, p.step, pair(age - 1).gradient_change)
                        : add_and_dot(direction_, fraction, p.step, direction_);
    }
    direction_ = -direction_;
}

void QuasiNewton::direction(const InverseMetric& metric) {
    if (in_single_.empty())
        direction(metric, in_double_);
    else
        direction(metric, in_single_);
}

// Stores the pair of a step from gradient_ to trial_gradient_ if its curvature is positive.
template <class Real>
void QuasiNewton::remember(double step_length, const Points& step, Ring<Real>& pairs) {
    if (pairs.empty()) return;
    const int ring = static_cast<int>(pairs.size());
    const int next = kept_ == 0 ? 0 : (newest_ + 1) % ring;
    Pair<Real>& p = pairs[static_cast<std::size_t>(next)];
    p.step = (step_length * step).template cast<Real>();
    p.gradient_change = (trial_gradient_ - gradient_).template cast<Real>();
    const double product = dot(p.step, p.gradient_change);
    const double smallest =
        1e-10 * std::sqrt(dot(p.step, p.step) * dot(p.gradient_change, p.gradient_change));
    if (product > smallest) {
        p.inverse_product = 1.0 / product;
        newest_ = next;
        kept_ = std::min(kept_ + 1, ring);
    } else if (kept_ == ring) {
        --kept_;  // the oldest pair has just been overwritten
    }
}

void QuasiNewton::remember(double step_length, const Points& step) {
    if (in_single_.empty())
        remember(step_length, step, in_double_);
    else
        remember(step_length, step, in_single_);
}

StepReport QuasiNewton::minimise(const EnergyAndGradient& energy, const SparseCholesky& metric,
                                 Points& x, const QuasiNewtonOptions& options) {
    return minimise(
        energy, [&](const Points& b, Points& y) { metric.solve(b, y); }, x, options);
}

StepReport QuasiNewton::minimise(const EnergyAndGradient& energy, const InverseMetric& metric,
                                 Points& x, const QuasiNewtonOptions& options,
                                 std::span<const Points> warm_start) {
    const long n = x.rows();
    const auto memory = static_cast<std::size_t>(std::max(options.memory, 0));
    in_double_.resize(options.pairs == Precision::kDouble ? memory : 0);
    in_single_.resize(options.pairs == Precision::kSingle ? memory : 0);
    kept_ = 0;
    newest_ = 0;
    gradient_.resize(n, 3);
    trial_gradient_.resize(n, 3);

    StepReport report;
    double e = energy(x, gradient_);
    report.evaluations = 1;
    report.energy_j = e;

    try_moves(energy, warm_start, e, x, report);

    for (int iteration = 0; iteration < options.iterations; ++iteration) {
        direction(metric);
        double slope = dot(gradient_, direction_);
        if (!(slope < 0) && kept_ > 0) {  // the memory is misleading: clear it
            kept_ = 0;
            direction(metric);
            slope = dot(gradient_, direction_);
        }
        if (slope == 0) {
            report.converged = true;
            return report;
        }

        // Armijo's condition with halving, from the full step or the longest step the cap allows.
        const double longest = longest_row(direction_);
        double t = longest > options.step_cap_m ? options.step_cap_m / longest : 1.0;
        const auto rms_step_m = [&] {
            return t *
                   std::sqrt(dot(direction_, direction_) / static_cast<double>(std::max(n, 1L)));
        };
        if (options.trust_last && iteration + 1 == options.iterations && report.backtracks == 0 &&
            slope < 0) {
            x += t * direction_;
            ++report.iterations;
            report.last_step_rms_m = rms_step_m();
            report.converged = report.last_step_rms_m < options.tolerance_rms_m;
            return report;
        }
        double trial_energy = 0;
        bool accepted = false;
        for (int halving = 0; halving <= options.backtracks && slope < 0; ++halving) {
            // At rest rounding hides the decrease of the energy: shorter and shorter moves would find nothing either
            if (halving > 0 && t * longest < options.shortest_m) break;
            trial_ = x + t * direction_;
            trial_energy = energy(trial_, trial_gradient_);
            ++report.evaluations;
            // Written so that NaN is rejected.
            if (trial_energy <= e + options.sufficient_decrease * t * slope) {
                accepted = true;
                break;
            }
            ++report.backtracks;
            t *= 0.5;
        }
        if (!accepted) {
            if (kept_ > 0) {  // tries the plain metric's direction; it costs one iteration
                kept_ = 0;
                ++report.iterations;
                continue;
            }
            // No lower energy within rounding, and the requested step is below the tolerance: this is the minimum.
            const double wanted =
                std::sqrt(dot(direction_, direction_) / static_cast<double>(std::max(n, 1L)));
            report.converged = wanted < options.tolerance_rms_m;
            report.stalled = !report.converged;
            return report;
        }

        remember(t, direction_);
        x.swap(trial_);
        gradient_.swap(trial_gradient_);
        e = trial_energy;
        ++report.iterations;
        report.energy_j = e;
        report.last_step_rms_m = rms_step_m();
        if (report.last_step_rms_m < options.tolerance_rms_m &&
            report.iterations >= options.min_iterations) {
            report.converged = true;
            return report;
        }
    }
    return report;
}

void QuasiNewton::try_moves(const EnergyAndGradient& energy, std::span<const Points> moves,
                            double& e, Points& x, StepReport& report) {
    for (const Points& move : moves) {
        if (move.isZero(0.0)) continue;
        trial_ = x + move;
        const double trial_energy = energy(trial_, trial_gradient_);
        ++report.evaluations;
        remember(1.0, move);
        if (trial_energy <= e) {  // written so that NaN is rejected
            x.swap(trial_);
            gradient_.swap(trial_gradient_);
            report.energy_j = e = trial_energy;
        }
    }
}

StepReport minimise(const EnergyAndGradient& energy, const SparseCholesky& metric, Points& x,
                    const QuasiNewtonOptions& options) {
    QuasiNewton solver;
    return solver.minimise(energy, metric, x, options);
}

}  // namespace risorius::solve
