// SPDX-License-Identifier: MIT
/// \file
/// Isometric equilibria of a muscle between plates, and its tension over length.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "risorius/figures/detail/figure_result.h"
#include "risorius/figures/detail/run_options.h"
#include "risorius/softbody/muscle_body.h"

namespace risorius::figures {

struct Still {
    double tension_f0 = std::numeric_limits<double>::quiet_NaN();
    double stretch = 0;  ///< l / l0, mean over the chains
    double spread = 0;   ///< Musculotendon::segment_spread
    double bulge = 1;    ///< width of the middle over that at rest
    double volume_change_percent = 0;
    bool converged = false;
};

class StillMuscle {
  public:
    StillMuscle(const softbody::MuscleDescription& description, double activation);

    /// Solves for equilibrium at a normalised length (muscle_runs.h), starting from the current state.
    Still at(double length);
    double rest_volume_m3() const { return rest_volume_; }
    /// The current shape.
    Shape shape(const std::string& name, const std::string& caption) const;

  private:
    bool solve_equilibrium();

    softbody::MuscleDescription description_;
    std::shared_ptr<double> plate_m_ = std::make_shared<double>(0);
    softbody::MuscleBody muscle_;
    solve::MotionState state_;
    double rest_volume_;
};

/// Equilibria at ascending lengths. The solver goes outwards from the rest length, so that every equilibrium starts near the
/// previous one.
std::vector<Still> still_over(const softbody::MuscleDescription& muscle, double activation,
                              const std::vector<double>& lengths, const RunOptions& options);

/// The peak of an isometric force-length curve.
struct TensionPeak {
    /// Vertex of the parabola through the largest value and its neighbours
    double force_f0 = 0, length = 0;
    double range = 0;  ///< range of lengths where the force is above a fraction of the peak
};
/// `fraction`: of the peak, for TensionPeak::range.
TensionPeak peak_of(const std::vector<double>& lengths, const std::vector<double>& force_f0,
                    double fraction);

}  // namespace risorius::figures
