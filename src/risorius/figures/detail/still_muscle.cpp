// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/still_muscle.h"

#include <algorithm>

#include "risorius/figures/detail/muscle_runs.h"
#include "risorius/solve/newton.h"

namespace risorius::figures {
namespace {

/// Position where a polyline first falls below a height, going left (-1) or right (+1) from its maximum; its last point if it
/// never does.
double crossing(const std::vector<double>& x, const std::vector<double>& y, std::size_t max,
                int direction, double height) {
    std::size_t i = max;
    for (;;) {
        if (direction < 0 ? i == 0 : i + 1 == x.size()) return x[i];
        const std::size_t next = direction < 0 ? i - 1 : i + 1;
        if (y[next] < height) return x[i] + (x[next] - x[i]) * (y[i] - height) / (y[i] - y[next]);
        i = next;
    }
}

}  // namespace

StillMuscle::StillMuscle(const softbody::MuscleDescription& description, double activation)
    : description_(description),
      muscle_(softbody::build_muscle(
          description, {.activation = [activation](double) { return activation; },
                        .lengthening_m = [plate = plate_m_](double) { return *plate; }})),
      state_(muscle_.body.start()),
      rest_volume_(muscle_.body.volume(muscle_.body.rest)) {}

bool StillMuscle::solve_equilibrium() {
    const solve::IntegratorReport report =
        solve::equilibrium(muscle_.body.system, state_,
                           {.method = solve::Method::kQuasiStatic,
                            .step_s = 1.0 / 60,
                            .length_scale_m = muscle_.body.length_scale_m});
    return report.converged && !report.diverged;
}

Still StillMuscle::at(double length) {
    *plate_m_ = lengthening_m(description_, length);
    Still still;
    still.converged = is_at_rest(muscle_, state_) || solve_equilibrium();
    still.tension_f0 = muscle_.tension(0, state_.x);
    still.stretch = muscle_.musculotendon->stretch(state_.x).mean();
    still.spread = muscle_.musculotendon->segment_spread(state_.x);
    still.bulge = bulge(muscle_.body, state_.x);
    still.volume_change_percent = 100 * (muscle_.body.volume(state_.x) / rest_volume_ - 1);
    return still;
}

Shape StillMuscle::shape(const std::string& name, const std::string& caption) const {
    return muscle_shape(muscle_, 0, state_.x, name, caption);
}

std::vector<Still> still_over(const softbody::MuscleDescription& muscle, double activation,
                              const std::vector<double>& lengths, const RunOptions& options) {
    std::vector<Still> found(lengths.size());
    const auto middle =
        std::lower_bound(lengths.begin(), lengths.end(), normalised_length(muscle, 0)) -
        lengths.begin();
    StillMuscle longer(muscle, activation), shorter(muscle, activation);
    for (auto i = static_cast<std::size_t>(middle); i < lengths.size(); ++i) {
        options.monitor.throw_if_stopped();
        found[i] = longer.at(lengths[i]);
    }
    for (auto i = static_cast<std::size_t>(middle); i-- > 0;) {
        options.monitor.throw_if_stopped();
        found[i] = shorter.at(lengths[i]);
    }
    return found;
}

TensionPeak peak_of(const std::vector<double>& lengths, const std::vector<double>& force_f0,
                    double fraction) {
    const std::vector<double>&x = lengths, &y = force_f0;
    const auto i = static_cast<std::size_t>(std::max_element(y.begin(), y.end()) - y.begin());
    TensionPeak peak{.force_f0 = y[i], .length = x[i]};
    if (i > 0 && i + 1 < y.size()) {
        const double a = x[i - 1] - x[i], b = x[i + 1] - x[i];
        const double p = (y[i - 1] - y[i]) / a, q = (y[i + 1] - y[i]) / b;
        const double curvature = (q - p) / (b - a), slope = p - curvature * a;
        if (curvature < 0) {
            const double at = -slope / (2 * curvature);
            peak.length = x[i] + at;
            peak.force_f0 = y[i] + slope * at / 2;
        }
    }
    const double height = fraction * peak.force_f0;
    peak.range = crossing(x, y, i, 1, height) - crossing(x, y, i, -1, height);
    return peak;
}

}  // namespace risorius::figures
