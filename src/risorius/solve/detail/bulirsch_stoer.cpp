// SPDX-License-Identifier: MIT
// Bulirsch & Stoer: Gragg's modified midpoint rule with 2, 4, 6 ... substeps, extrapolated to substep size 0 by polynomials in
// its square. Order and step are chosen for the least work per second of motion.
// Source: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, II.9.
//
//   k      column of the extrapolation table, of order 2 k + 2
//   H      the whole step, s
#include <algorithm>
#include <array>
#include <cmath>

#include "risorius/solve/detail/methods.h"
#include "risorius/solve/detail/stepper.h"

namespace risorius::solve::detail {

namespace {

constexpr int kRows = 8;  ///< maximum number of rows of the table: 16 substeps, order 16

constexpr int substeps(int row) { return 2 * (row + 1); }

class BulirschStoer final : public ControlledStepper {
  public:
    using ControlledStepper::ControlledStepper;

  protected:
    Attempt attempt(const MotionSystem& system, const Points& x, const Points& v, double t,
                    double H, bool first, IntegratorReport& report) override {
        if (first) {
            system.acceleration(t, x, v, a_);
            ++report.evaluations;
        }
        std::array<double, kRows> best_step{}, work{};
        const int last = std::min(target_ + 1, kRows - 1);
        for (int k = 0; k <= last; ++k) {
            add_row(system, x, v, t, H, k);
            report.evaluations += substeps(k);
            if (k == 0) continue;
            const double error = newest_error(k, H);
            if (!std::isfinite(error)) return {error, 0.1 * H};

            const auto at = static_cast<std::size_t>(k);
            best_step[at] = H * growth(error, k);
            work[at] = evaluations_to(k) / best_step[at];
            if (k < target_ - 1 && k < last) continue;
            if (error <= 1) {
                trial_x_ = table_x_[at];
                trial_v_ = table_v_[at];
                return {error, next_step(best_step, work, k)};
            }
            if (k == last || hopeless(error, k)) {
                // Repeats the step with the size that this order would have needed.
                if (k > 2 && work[at - 1] < 0.8 * work[at])
                    target_ = k - 1;
                else
                    target_ = std::min(target_, std::max(k, 2));
                const auto order = static_cast<std::size_t>(std::min(target_, k));
                return {error, std::min(best_step[order], 0.7 * H)};
            }
        }
        return {2, 0.5 * H};
    }

    void forget() override { target_ = 4; }

  private:
    /// Applies Gragg's rule over H, smoothed, as the newest row of the table, and extrapolates along the row.
    void add_row(const MotionSystem& system, const Points& x, const Points& v, double t, double H,
                 int k) {
        const int n = substeps(k);
        const double h = H / n;
        before_x_ = x;
        before_v_ = v;
        now_x_ = x + h * v;
        now_v_ = v + h * a_;
        for (int m = 1; m <= n; ++m) {
            const double now_s = m == n ? t + H : t + m * h;
            system.place_fixed(now_s, now_x_, now_v_);
            system.acceleration(now_s, now_x_, now_v_, rate_);
            if (m == n) break;
            before_x_ += 2 * h * now_v_;
            before_v_ += 2 * h * rate_;
            before_x_.swap(now_x_);
            before_v_.swap(now_v_);
        }
        // From the left, table[k] gets the values of the new row: T(k, 0), then T(k, 1) ... Entries not yet replaced are those
        // of row k - 1.
        carried_x_ = 0.5 * (now_x_ + before_x_ + h * now_v_);
        carried_v_ = 0.5 * (now_v_ + before_v_ + h * rate_);
        for (int j = 0; j < k; ++j) {
            const auto at = static_cast<std::size_t>(j);
            const double ratio = static_cast<double>(n) / substeps(k - 1 - j);
            const double fraction = 1 / (ratio * ratio - 1);
            // T(k, j + 1) = T(k, j) + (T(k, j) - T(k - 1, j)) / (ratio^2 - 1)
            table_x_[at].swap(carried_x_);
            table_v_[at].swap(carried_v_);
            carried_x_ = table_x_[at] + fraction * (table_x_[at] - carried_x_);
            carried_v_ = table_v_[at] + fraction * (table_v_[at] - carried_v_);
        }
        table_x_[static_cast<std::size_t>(k)].swap(carried_x_);
        table_v_[static_cast<std::size_t>(k)].swap(carried_v_);
    }

    double newest_error(int k, double H) {
        const auto at = static_cast<std::size_t>(k);
        rate_ = table_v_[at] - table_v_[at - 1];
        now_x_ = table_x_[at] - table_x_[at - 1];
        return scaled_error(now_x_, rate_, H);
    }

    /// Factor to the step size that column k would just accept, (9.24).
    static double growth(double error, int k) {
        const double power = 1.0 / (2 * k + 1);
        const double min = std::pow(0.02, power);
        const double factor =
            error > 0 ? 0.94 * std::pow(0.65 / error, power) : std::numeric_limits<double>::max();
        return std::clamp(factor, min / 4, 1 / min);
    }

    /// Number of evaluations for rows 0 to k.
    static double evaluations_to(int k) {
        double sum = 1;
        for (int row = 0; row <= k; ++row) sum += substeps(row);
        return sum;
    }

    /// True when the remaining rows cannot be expected to be accepted, (9.27), (9.28).
    bool hopeless(double error, int k) const {
        const auto ratio = [](int row) { return static_cast<double>(substeps(row)) / substeps(0); };
        if (k < target_ && k + 2 < kRows) return error > std::pow(ratio(k + 1) * ratio(k + 2), 2);
        return k + 1 < kRows && error > std::pow(ratio(k + 1), 2);
    }

    /// Chooses the order of least work around the accepted k. Returns its step, (9.29), (9.30).
    double next_step(const std::array<double, kRows>& best_step,
                     const std::array<double, kRows>& work, int k) {
        const auto at = static_cast<std::size_t>(k);
        if (k >= 3 && work[at - 1] < 0.8 * work[at]) {
            target_ = k - 1;
            return best_step[at - 1];
        }
        const bool one_more = k < 2 || work[at] < 0.9 * work[at - 1];
        if (one_more && k + 1 < kRows - 1) {
            target_ = k + 1;
            return best_step[at] * evaluations_to(k + 1) / evaluations_to(k);
        }
        target_ = std::max(k, 2);
        return best_step[at];
    }

    int target_ = 4;  ///< column where convergence is expected
    std::array<Points, kRows> table_x_, table_v_;
    Points a_, before_x_, before_v_, now_x_, now_v_, rate_, carried_x_, carried_v_;
};

}  // namespace

std::unique_ptr<Integrator> make_bulirsch_stoer(const IntegratorOptions& options) {
    return std::make_unique<BulirschStoer>(options);
}

}  // namespace risorius::solve::detail
