// SPDX-License-Identifier: MIT
// Line-search Newton for implicit steps, and mass-regularised Newton for equilibria.
#include "risorius/solve/newton.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "risorius/solve/point_sums.h"

namespace risorius::solve {

namespace {

constexpr double kSufficientDecrease = 1e-4;  ///< Armijo
constexpr int kHalvings = 60;
/// When a line search ends below this fraction of Newton's move, regularised moves take over.
constexpr double kShortestFraction = 1.0 / 64;
/// Rounding of an energy, as a fraction of it. Smaller decreases cannot be seen, so the gradient decides.
constexpr double kEnergyRounding = 1e-13;
constexpr int kPositiveIterations = 3;  ///< after an indefinite exact curvature
constexpr int kConjugateIterations = 2000;

bool all_finite(const Points& x) {
    double poison = 0;
    for (long i = 0; i < x.size(); ++i) poison += 0.0 * x.data()[i];
    return poison == 0;
}

/// Maximum of |gradient / mass| over the free nodes, m/s^2.
double max_acceleration(const MotionSystem& system, const Points& gradient) {
    double largest = 0;
    for (int i = 0; i < system.size(); ++i)
        if (!system.fixed()[static_cast<std::size_t>(i)])
            largest =
                std::max(largest, gradient.row(i).cwiseAbs().maxCoeff() / system.mass_kg()[i]);
    return largest;
}

double squared_in_mass(const MotionSystem& system, const Points& d) {
    double sum = 0;
    for (int i = 0; i < system.size(); ++i)
        if (!system.fixed()[static_cast<std::size_t>(i)]) {
            const double* p = d.data() + 3L * i;
            sum += system.mass_kg()[i] * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        }
    return sum;
}

}  // namespace

HessianBuilder& Newton::hessian_of(const MotionSystem& system) {
    if (!hessian_ || hessian_->nodes() != system.size() || hessian_->fixed() != system.fixed())
        hessian_ = std::make_unique<HessianBuilder>(system.size(), system.fixed());
    return *hessian_;
}

double Newton::evaluate(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                        const Points& x, Points& gradient, NewtonReport& report) const {
    ++report.evaluations;
    double sum = system.potential(step, x, gradient);
    const double rate = step.rate_hz();
    if (rate == 0) return sum;
    for (int i = 0; i < system.size(); ++i) {
        if (system.fixed()[static_cast<std::size_t>(i)]) continue;
        const double weight = system.mass_kg()[i] * rate * rate;
        const double* p = x.data() + 3L * i;
        const double* y = target.data() + 3L * i;
        double* g = gradient.data() + 3L * i;
        for (int k = 0; k < 3; ++k) {
            const double d = p[k] - y[k];
            sum += 0.5 * weight * d * d;
            g[k] += weight * d;
        }
    }
    return sum;
}

bool Newton::solve(const MotionSystem& system, const ImplicitStep& step, const Points& x,
                   double mass_weight, Curvature curvature, LinearSolver linear, double tolerance,
                   bool any_sign, NewtonReport& report) {
    HessianBuilder& hessian = hessian_of(system);
    hessian.clear();
    system.add_hessian(step, x, curvature, hessian);
    for (int i = 0; i < system.size(); ++i)
        if (!system.fixed()[static_cast<std::size_t>(i)])
            hessian.add_diagonal(i, mass_weight * system.mass_kg()[i]);
    ++report.linear_solves;
    scratch_ = -gradient_;
    if (linear == LinearSolver::kConjugate) {
        const SymmetricBlocks& A = hessian.build_blocks();
        const ConjugateGradientReport found =
            gradients_.solve(A, scratch_, tolerance, kConjugateIterations, direction_);
        // A block below the diagonal counts twice, the diagonal and its inverse once each.
        report.multiplications += 18.0 * static_cast<double>(A.row.size()) * found.iterations;
        return !found.negative_curvature && all_finite(direction_);
    }
    const Definiteness definite = factor_.factorise(hessian.build(), 3);
    if (definite == Definiteness::kSingular) return false;
    if (definite == Definiteness::kIndefinite && !any_sign) return false;
    direction_.resize(x.rows(), 3);
    factor_.solve(scratch_.data(), direction_.data(), 1);
    if (!all_finite(direction_)) return false;
    if (definite == Definiteness::kIndefinite) {
        // Without pivoting, a tiny pivot may have spoilt the factor.
        multiply(hessian.build_blocks(), direction_, trial_gradient_);
        trial_gradient_ -= scratch_;
        constexpr double kResidual = 1e-6;
        if (!(dot(trial_gradient_, trial_gradient_) <=
              kResidual * kResidual * dot(scratch_, scratch_)))
            return false;
    }
    return true;
}

NewtonReport Newton::minimise(const MotionSystem& system, const ImplicitStep& step,
                              const Points& target, const NewtonOptions& options, Points& x) {
    assert(std::isfinite(step.step_s));
    NewtonReport report;
    const double inertia = step.rate_hz() * step.rate_hz();
    double e = evaluate(system, step, target, x, gradient_, report);
    const double first_slope = std::sqrt(dot(gradient_, gradient_));
    double energy_scale = std::abs(e);
    double move_before = std::numeric_limits<double>::infinity();
    Curvature curvature = options.curvature;
    int hold = 0;  // iterations until the exact curvature is tried again
    report.potential_j = e;
    if (!std::isfinite(e) || !std::isfinite(first_slope)) {
        report.diverged = true;
        return report;
    }

    while (report.iterations < options.iterations) {
        // Conjugate gradients end early far from the minimum and late near it (Nocedal & Wright, 7.1).
        const double slope_fraction = std::sqrt(dot(gradient_, gradient_)) / first_slope;
        const double tolerance = std::clamp(0.1 * std::sqrt(slope_fraction), 1e-9, 1e-2);
        if (first_slope == 0) {
            report.converged = true;
            return report;
        }
        bool solved = solve(system, step, x, inertia, curvature, options.linear, tolerance,
                            /*any_sign=*/false, report);
        if (!solved && curvature == Curvature::kExact) {
            curvature = Curvature::kPositive;
            hold = kPositiveIterations;
            solved = solve(system, step, x, inertia, curvature, options.linear, tolerance,
                           /*any_sign=*/false, report);
        }
        // Reached only when the positive curvature of some term is not quite positive.
        for (double shift = 1; !solved && shift < 1e12; shift *= 100)
            solved = solve(system, step, x, inertia * (1 + shift), curvature, options.linear,
                           tolerance, /*any_sign=*/false, report);
        const double slope = dot(gradient_, direction_);
        if (!solved || !(slope <= 0)) return report;
        const double move = longest_row(direction_);
        report.last_move_m = move;

        // Armijo's condition with halving. Where rounding hides the decrease, the slope at the trial must not have changed sign
        // (approximate Wolfe conditions, Hager & Zhang 2005).
        const double rounding = kEnergyRounding * energy_scale;
        double t = 1, trial_e = 0;
        bool accepted = false;
        for (int halving = 0; halving <= kHalvings; ++halving) {
            trial_ = x + t * direction_;
            trial_e = evaluate(system, step, target, trial_, trial_gradient_, report);
            accepted = trial_e <= e + kSufficientDecrease * t * slope ||
                       (trial_e <= e + rounding && std::abs(dot(trial_gradient_, direction_)) <=
                                                       (1 - 2 * kSufficientDecrease) * -slope);
            if (accepted) break;
            ++report.halvings;
            if (-t * slope <= rounding) break;
            t *= 0.5;
        }
        if (!accepted) {
            report.converged = move <= options.tolerance_m;
            return report;
        }
        x.swap(trial_);
        gradient_.swap(trial_gradient_);
        e = trial_e;
        energy_scale = std::max(energy_scale, std::abs(e));
        report.potential_j = e;
        ++report.iterations;
        if (move <= options.tolerance_m) {
            report.converged = true;
            return report;
        }
        if (t < kShortestFraction) {
            // The mass weight whose move would be about as long as the accepted one.
            const double added = max_acceleration(system, gradient_) / (t * move);
            regularised(system, step, target, options, e, added, x, report);
            return report;
        }

        if (hold > 0)
            --hold;
        else if (curvature == Curvature::kPositive && move > 0.1 * move_before)
            curvature = Curvature::kExact;
        else if (options.curvature == Curvature::kExact)
            curvature = Curvature::kExact;
        move_before = move;
    }
    return report;
}

NewtonReport Newton::solve_equilibrium(const MotionSystem& system, const ImplicitStep& step,
                                       const NewtonOptions& options, Points& x) {
    assert(!std::isfinite(step.step_s));
    NewtonReport report;
    const double e = evaluate(system, step, x, x, gradient_, report);
    report.potential_j = e;
    if (!std::isfinite(e) || !all_finite(gradient_)) {
        report.diverged = true;
        return report;
    }
    regularised(system, step, x, options, e, std::pow(options.first_step_s, -2), x, report);
    return report;
}

// Levenberg's regularisation with the mass matrix. The added weight a is 1 / (pseudo-time step)^2. It shrinks while the
// quadratic model predicts the decrease, and grows where it does not or where H + a M is not positive definite.
void Newton::regularised(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                         const NewtonOptions& options, double e, double added, Points& x,
                         NewtonReport& report) {
    const bool settling = step.rate_hz() == 0;
    const double inertia = step.rate_hz() * step.rate_hz();
    if (settling) began_ = x;
    double energy_scale = std::abs(e);
    double min = 0;
    Curvature curvature = options.curvature;
    int hold = 0;

    while (report.iterations < options.iterations && std::isfinite(added)) {
        if (dot(gradient_, gradient_) == 0) {
            report.converged = true;
            return;
        }
        constexpr double kLinearTolerance = 1e-3;
        ++report.iterations;
        if (!solve(system, step, x, inertia + added, curvature, options.linear, kLinearTolerance,
                   /*any_sign=*/false, report)) {
            if (curvature == Curvature::kExact) {
                curvature = Curvature::kPositive;
                hold = kPositiveIterations;
            } else {
                ++report.halvings;
                min = std::max(min, 2 * added);
                added *= 16;
            }
            continue;
        }
        const double slope = dot(gradient_, direction_);
        const double move = longest_row(direction_);
        const double regular = added * squared_in_mass(system, direction_);
        const double predicted = 0.5 * (-slope + regular);  // decrease of the quadratic model
        const bool plain = regular <= 1e-2 * -slope;        // as good as Newton's own move
        report.last_move_m = move;

        trial_ = x + direction_;
        const double trial_e = evaluate(system, step, target, trial_, trial_gradient_, report);
        const double rounding = kEnergyRounding * energy_scale;
        // Ratio of actual to predicted decrease. Where rounding hides it, the gradient must have become smaller.
        double gain = (e - trial_e) / predicted;
        if (std::abs(predicted) <= 10 * rounding && std::abs(e - trial_e) <= 20 * rounding)
            gain = dot(trial_gradient_, trial_gradient_) < dot(gradient_, gradient_) ? 1 : 0;

        if (slope <= 0 && gain > kSufficientDecrease) {  // NaN is rejected
            x.swap(trial_);
            gradient_.swap(trial_gradient_);
            e = trial_e;
            energy_scale = std::max(energy_scale, std::abs(e));
            report.potential_j = e;
            if (settling) {
                trial_ = x - began_;
                if (!(longest_row(trial_) <= options.farthest_m)) {
                    report.diverged = true;
                    return;
                }
            }
        } else {
            ++report.halvings;
        }
        if (plain && move <= options.tolerance_m) {
            report.converged = true;
            return;
        }
        if (!(gain > 0.25)) {
            added *= 4;
            min = 0;  // it belonged to another position
        } else if (gain > 0.75) {
            added = std::max(added / 16, min);
        }
        if (hold > 0)
            --hold;
        else if (options.curvature == Curvature::kExact || regular <= 0.1 * -slope)
            curvature = Curvature::kExact;
    }
}

bool Newton::move_once(const MotionSystem& system, const ImplicitStep& step, const Points& target,
                       LinearSolver linear, Points& x, NewtonReport& report) {
    const double inertia = step.rate_hz() * step.rate_hz();
    report.potential_j = evaluate(system, step, target, x, gradient_, report);
    constexpr double kLinearTolerance = 1e-9;
    bool solved = solve(system, step, x, inertia, Curvature::kExact, linear, kLinearTolerance,
                        /*any_sign=*/true, report);
    if (!solved) {
        ++report.halvings;
        solved = solve(system, step, x, inertia, Curvature::kPositive, linear, kLinearTolerance,
                       /*any_sign=*/true, report);
    }
    if (!solved) return false;
    x += direction_;
    report.last_move_m = longest_row(direction_);
    ++report.iterations;
    return true;
}

}  // namespace risorius::solve
