// SPDX-License-Identifier: MIT
/// \file
/// The prototype muscle on its test bench: 40 mm long, 10 mm in radius, 0.30 MPa of specific tension, cells of 5 MPa.
#pragma once

#include <gtest/gtest.h>

#include "risorius/muscle/equilibrium.h"
#include "risorius/softbody/muscle_body.h"
#include "risorius/solve/integrator.h"

namespace risorius::testing_of {

inline softbody::MuscleDescription prototype_muscle(
    const tissue::GridShape& grid, double radius_m = 0.01,
    softbody::Discretisation discretisation = softbody::Discretisation::kCells) {
    softbody::MuscleDescription d;
    d.place = "muscle";
    d.discretisation = discretisation;
    d.grid = grid;
    d.length_m = 0.04;
    d.width_m = d.thickness_m = 2 * radius_m;
    d.moduli = {.mu_pa = 2e3,
                .bulk_pa = discretisation == softbody::Discretisation::kCells ? 5e6 : 0.2e6,
                .viscosity_pa_s = 200};
    d.musculotendon = {.f0_n = 94.2 * radius_m * radius_m / 1e-4,
                       .optimal_length_m = 0.04,
                       .tendon_slack_m = 0.02,
                       .max_speed_hz = 10,
                       .damping = 0.1};
    return d;
}

/// A muscle that goes from one equilibrium to the next. Each one is the start for the next.
class MuscleBench {
  public:
    explicit MuscleBench(const softbody::MuscleDescription& description)
        : muscle_(softbody::build_muscle(
              description, {.activation = [this](double) { return activation_; },
                            .lengthening_m = [this](double) { return lengthening_m_; }})),
          still_(solve::make_integrator({.method = solve::Method::kQuasiStatic,
                                         .step_s = 1,
                                         .length_scale_m = muscle_.body.length_scale_m})),
          state_(muscle_.body.start()) {}
    MuscleBench(const MuscleBench&) = delete;
    MuscleBench& operator=(const MuscleBench&) = delete;

    /// The equilibrium at an activation, with the anchors farther apart than in the rest shape by `lengthening_m`.
    const Points& at(double activation, double lengthening_m) {
        activation_ = activation;
        lengthening_m_ = lengthening_m;
        const solve::IntegratorReport report = still_->advance(muscle_.body.system, state_, 0);
        EXPECT_TRUE(report.converged && !report.diverged)
            << "a = " << activation << ", lengthened by " << lengthening_m;
        return state_.x;
    }
    double tension() const { return muscle_.tension(0, state_.x); }  ///< divided by F0
    double volume_change() const {
        return muscle_.body.volume(state_.x) / muscle_.body.volume(muscle_.body.rest) - 1;
    }
    const Points& x() const { return state_.x; }
    const Points& rest() const { return muscle_.body.rest; }
    const softbody::MuscleBody& muscle() const { return muscle_; }

  private:
    double activation_ = 0, lengthening_m_ = 0;
    softbody::MuscleBody muscle_;
    std::unique_ptr<solve::Integrator> still_;
    solve::MotionState state_;
};

/// Tension of fibre and tendon in one dimension, divided by F0, at the normalised length (lMT - lTs) / l0.
inline double line_tension(const muscle::MuscleParameters& p, double normalised,
                           double activation) {
    return muscle::equilibrium(p, muscle::make_curves(p.curves), activation,
                               normalised * p.optimal_length_m + p.tendon_slack_m)
               .force_n /
           p.f0_n;
}

}  // namespace risorius::testing_of
