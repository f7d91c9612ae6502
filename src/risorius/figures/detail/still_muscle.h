// SPDX-License-Identifier: MIT
/// \file
/// A muscle at rest between plates that are put somewhere, and what its tension is over that.
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
    double stretch = 0;  ///< l / l0, mean of the chains
    double spread = 0;   ///< Musculotendon::segment_spread
    double bulge = 1;    ///< width of the middle over that at rest
    double volume_change_percent = 0;
    bool converged = false;
};

class StillMuscle {
  public:
    StillMuscle(const softbody::MuscleDescription& description, double activation);

    /// Brought to rest at a normalised length (muscle_runs.h), from where it was.
    Still at(double length);
    double rest_volume_m3() const { return rest_volume_; }
    /// As it lies now.
    Shape shape(const std::string& name, const std::string& caption) const;

  private:
    bool solve_equilibrium();

    softbody::MuscleDescription description_;
    std::shared_ptr<double> plate_m_ = std::make_shared<double>(0);
    softbody::MuscleBody muscle_;
    solve::MotionState state_;
    double rest_volume_;
};

/// One per length, which rise. Goes from rest outwards, so that every equilibrium begins near the one before it.
std::vector<Still> still_over(const softbody::MuscleDescription& muscle, double activation,
                              const std::vector<double>& lengths, const RunOptions& options);

/// Of a force over lengths.
struct TensionPeak {
    double force_f0 = 0,
           length = 0;  ///< vertex of the parabola through the greatest and its neighbours
    double range = 0;   ///< of lengths where force is above a share of that
};
TensionPeak peak_of(const std::vector<double>& lengths, const std::vector<double>& force_f0,
                    double fraction);

}  // namespace risorius::figures
