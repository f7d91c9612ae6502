// SPDX-License-Identifier: MIT
/// \file
/// Finds the intensity at which an expression is seen as a share of what the same expression shows at full intensity.
///
///   s(k)     farthest way of a landmark of the face, settled at intensity k (seen_motion.h)
///   p(k)     the same for the course of the script, which is less when nothing is held
///
/// First s(k) / s(1) = share is solved by regula falsi with the Illinois rule, then p(k) / s(1) = share by secants in log p over log k.
///
/// It also finds the duration T of a rise at which the movement is at its apex in a given frame: c(T), the time at which s of the course
/// passes 99 % of its maximum, is solved by regula falsi for the middle of the time before that frame.
///
/// What was simulated is kept between runs, see known_motion.h.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "risorius/animate/render_inputs.h"
#include "risorius/animate/render_session.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::stimuli {

class MotionMatch {
  public:
    /// `quality`: that of the clips. `searches`: how many will be asked for, for the progress; the monitor is told of those that are
    /// not known from an earlier run.
    MotionMatch(std::string quality, animate::RenderInputs& inputs, long searches,
                ProgressMonitor monitor)
        : quality_(std::move(quality)),
          inputs_(inputs),
          searches_(searches),
          monitor_(std::move(monitor)) {}

    /// Returns the intensity, to 1e-4. `script_at`: the script at an intensity; `folder`: where its relative paths start. Throws Error
    /// naming `place` when the script has no expression, or when the share cannot be had.
    double intensity_for(double share, const std::function<Json(double)>& script_at,
                         const std::filesystem::path& folder, const std::string& place);

    /// Returns the duration, s, to 1e-4. `script_at`: the script at a duration. Throws Error naming `place` when the apex cannot be in the
    /// frame nearest to `apex_s`.
    double time_for(double apex_s, const std::function<Json(double)>& script_at,
                    const std::filesystem::path& folder, const std::string& place);

  private:
    /// What landmarks do in a course.
    struct Course {
        std::vector<double> way_mm;  ///< s of each frame
        int fps = 60;
        double most_mm() const;
        double apex_s() const;  ///< when s passes 99 % of its maximum, between frames
    };
    const Course& course_of(const Json& script, const std::filesystem::path& folder,
                            const std::string& place);
    double settled_mm(const Json& script, const std::filesystem::path& folder,
                      const std::string& place);
    void report(const std::string& place) const;

    std::string quality_;
    animate::RenderInputs& inputs_;
    long searches_, begun_ = 0;
    ProgressMonitor monitor_;
    animate::RenderSession session_;
    std::map<std::string, double> known_;
    std::map<std::string, Course> courses_;
};

}  // namespace risorius::stimuli
