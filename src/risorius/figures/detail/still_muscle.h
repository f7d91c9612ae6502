// SPDX-License-Identifier: MIT
/// \file
/// Isometric equilibria of a muscle between plates, and its tension as a function of length.
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
    double spread = 0;   ///< Musculotendon::segment_spread()
    double bulge = 1;    ///< width of the middle over that at rest
    double volume_change_percent = 0;
    bool converged = false;
};

class StillMuscle {
  public:
    StillMuscle(const softbody::MuscleDescription& description, double activation);

    /// Computes the equilibrium at a normalised length (muscle_runs.h), starting from the current state.
    Still at(double length);
    double rest_volume_m3() const { return rest_volume_; }
    /// Returns the shape in the current state for drawing.
    Shape shape(const std::string& name, const std::string& caption) const;

  private:
    bool solve_equilibrium();

    softbody::MuscleDescription description_;
    std::shared_ptr<double> plate_m_ = std::make_shared<double>(0);
    softbody::MuscleBody muscle_;
    solve::MotionState state_;
    double rest_volume_;
};

/// Computes the equilibria at lengths in ascending order. The solver starts near the rest length and goes to shorter and to
/// longer ones, so that every equilibrium starts from a state near it.
std::vector<Still> still_over(const softbody::MuscleDescription& muscle, double activation,
                              const std::vector<double>& lengths, const RunOptions& options);

/// The peak of an isometric force-length curve.
struct TensionPeak {
    /// The peak: vertex of the parabola through the largest value and its two neighbours. Force over F0, normalised length
    double force_f0 = 0, length = 0;
    /// Width of the range of lengths where the force is above a fraction of the peak
    double range = 0;
};
/// Finds the peak of a curve given by points. `fraction`: the fraction of the peak that TensionPeak::range uses.
TensionPeak peak_of(const std::vector<double>& lengths, const std::vector<double>& force_f0,
                    double fraction);

}  // namespace risorius::figures
