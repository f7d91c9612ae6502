// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/muscle_motion.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "risorius/figures/detail/muscle_runs.h"
#include "risorius/solve/newton.h"

namespace risorius::figures {
namespace {

/// The plate of the insertion under a load: moves with constant speed during a step.
struct LoadedPlate {
    bool free = false;
    double from_s = 0, from_m = 0;
    double speed_m_per_s = 0;

    double at(double t_s) const { return from_m + speed_m_per_s * (t_s - from_s); }
};

MuscleSample sample_of(const softbody::MuscleBody& muscle, const solve::MotionState& state,
                       double activation, double plate_m, double rest_volume) {
    return {.t_s = state.t_s,
            .activation = activation,
            .lengthening_m = plate_m,
            .tension_f0 = muscle.tension(state.t_s, state.x),
            .stretch = muscle.musculotendon->stretch(state.x).mean(),
            .volume_ratio = muscle.body.volume(state.x) / rest_volume};
}

}  // namespace

MuscleMotion move_muscle(const softbody::MuscleDescription& description, const MotionPlan& plan,
                         const RunOptions& options) {
    // The plate follows the plan until the load hangs on it.
    const auto plate = std::make_shared<LoadedPlate>();
    const auto planned = plan.task.lengthening_m;
    const auto plate_at = [plate, planned](double t_s) {
        if (plate->free) return plate->at(t_s);
        return planned ? planned(t_s) : 0;
    };
    const softbody::MuscleBody muscle = softbody::build_muscle(
        description, {.activation = plan.task.activation, .lengthening_m = plate_at});
    const muscle::MuscleParameters& parameters = muscle.musculotendon->parameters();
    const double rest_volume = muscle.body.volume(muscle.body.rest);
    const auto sample = [&](const solve::MotionState& state) {
        return sample_of(muscle, state, plan.task.activation(state.t_s), plate_at(state.t_s),
                         rest_volume);
    };

    // The motion starts in equilibrium.
    MuscleMotion motion;
    solve::IntegratorOptions how{.method = solve::Method::kQuasiStatic,
                                 .step_s = 1,
                                 .length_scale_m = muscle.body.length_scale_m};
    solve::MotionState state = muscle.body.start();
    motion.converged =
        is_at_rest(muscle, state) || solve::equilibrium(muscle.body.system, state, how).converged;
    motion.samples.push_back(sample(state));

    how.method = solve::Method::kImplicitEuler;
    double stop_m = 0;
    for (const Phase& phase : plan.phases) {
        const double begin_s = state.t_s;
        if (plan.load && !plate->free && begin_s >= plan.load->from_s) {
            stop_m = plate_at(begin_s);
            *plate = {.free = true, .from_s = begin_s, .from_m = stop_m};
        }
        const auto steps =
            static_cast<int>(std::ceil((phase.until_s - begin_s) / phase.step_s * (1 - 1e-9)));
        how.step_s = phase.until_s - begin_s;  // a single step, regardless of rounding
        const auto integrator = solve::make_integrator(how);
        for (int i = 1; i <= steps; ++i) {
            options.monitor.throw_if_stopped();
            const double before_s = state.t_s;
            const double until_s = begin_s + (phase.until_s - begin_s) * i / steps;
            if (plate->free) {
                const double step_s = until_s - before_s;
                const double force_n =
                    plan.load->force_n - parameters.f0_n * motion.samples.back().tension_f0;
                plate->from_m = plate->at(before_s);
                plate->from_s = before_s;
                plate->speed_m_per_s += step_s * force_n / plan.load->mass_kg;
                if (plate->at(until_s) > stop_m)
                    plate->speed_m_per_s = (stop_m - plate->from_m) / step_s;
            }
            const solve::IntegratorReport report =
                integrator->advance(muscle.body.system, state, until_s);
            ++motion.steps;
            motion.converged = motion.converged && report.converged;
            if (report.diverged) {
                motion.diverged = true;
                return motion;
            }
            MuscleSample now = sample(state);
            now.speed = (now.stretch - motion.samples.back().stretch) /
                        ((now.t_s - before_s) * parameters.max_speed_hz);
            motion.samples.push_back(now);
            if (plan.ended && plan.ended(now)) return motion;
        }
    }
    return motion;
}

std::vector<Phase> read_phases(const JsonCursor& json) {
    std::vector<Phase> phases;
    for (const JsonCursor& one : json.items()) {
        one.allow_keys({"until_s", "step_s"});
        const double until_s = one.at("until_s").number({0, 1e6});
        const double before_s = phases.empty() ? 0 : phases.back().until_s;
        if (!(until_s > before_s))
            one.at("until_s").fail("more than " + format_number(before_s) + ", where it begins");
        phases.push_back(
            {.until_s = until_s, .step_s = one.at("step_s").number({1e-7, until_s - before_s})});
    }
    if (phases.empty()) json.fail("at least one phase");
    return phases;
}

}  // namespace risorius::figures
