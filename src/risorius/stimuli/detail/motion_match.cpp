// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/motion_match.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/animate/landmark_run.h"
#include "risorius/animate/run_render_job.h"
#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/stimuli/detail/expression_script.h"
#include "risorius/stimuli/detail/seen_motion.h"

namespace risorius::stimuli {

namespace {

constexpr double kSettled = 0.005, kShown = 0.01;  // accepted differences of shares
constexpr int kSettledSteps = 10, kShownSteps = 4;
constexpr double kLeast_mm = 0.1;

animate::RenderJob job_of(const Json& script, const std::filesystem::path& folder,
                          const std::string& quality, const std::string& place,
                          animate::RenderInputs& inputs) {
    animate::RenderRequest request;
    request.script = folder / place;
    request.script_in_memory = JsonCursor::from_json(script, request.script.string());
    request.out = folder / "none.mkv";
    request.quality = quality;
    request.threads = 1;
    return animate::plan_render_job(request, inputs);
}

double rounded(double intensity) { return std::round(1e4 * intensity) / 1e4; }

}  // namespace

double MotionMatch::settled_mm(const Json& script, const std::filesystem::path& folder,
                               const std::string& place) {
    const std::optional<Json> settled = expression_settled(script);
    if (!settled) return 0;
    const std::string key = json_text(*settled) + folder.string();
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    monitor_.throw_if_stopped();
    return known_[key] = largest_way_mm(animate::settled_landmarks(
               job_of(*settled, folder, quality_, place, inputs_), session_));
}

double MotionMatch::shown_mm(const Json& script, const std::filesystem::path& folder,
                             const std::string& place) {
    const std::optional<Json> alone = expression_alone(script);
    if (!alone) return 0;
    const std::string key = "shown " + json_text(*alone) + folder.string();
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const animate::LandmarkFrames frames = animate::play_landmarks(
        job_of(*alone, folder, quality_, place, inputs_), session_, monitor_);
    double most = 0;
    for (const Points& frame : frames.positions_mm)
        most = std::max(most, largest_way_mm({frames.ids, {frames.positions_mm.front(), frame}}));
    return known_[key] = most;
}

double MotionMatch::intensity_for(double share, const std::function<Json(double)>& script_at,
                                  const std::filesystem::path& folder, const std::string& place) {
    const double full_mm = settled_mm(script_at(1), folder, place);
    if (full_mm < kLeast_mm)
        throw Error(place,
                    "a script whose expression or units follow the parameter of match/motion",
                    "one that moves the face by " + format_number(full_mm) + " mm at 1");
    // Settled face: f rises from -share at intensity 0.
    double low = 0, f_low = -share, high = 1, f_high = 1 - share, k = share;
    int last_side = 0;
    for (int step = 0; step < kSettledSteps && f_high > kSettled; ++step) {
        k = rounded(low + (high - low) * -f_low / (f_high - f_low));
        const double f = settled_mm(script_at(k), folder, place) / full_mm - share;
        if (std::abs(f) <= kSettled) break;
        const int side = f < 0 ? -1 : 1;
        (f < 0 ? low : high) = k;
        (f < 0 ? f_low : f_high) = f;
        // The Illinois rule: an end that stays twice counts half.
        if (side == last_side) (f < 0 ? f_high : f_low) /= 2;
        last_side = side;
    }
    if (1 - share <= kSettled) k = 1;

    // Its course
    const double most = shown_mm(script_at(1), folder, place) / full_mm;
    if (most < share - 2 * kShown)
        throw Error(place,
                    "a share of match/motion of at most " +
                        format_number(std::floor(100 * most) / 100) + ", or a longer onset or hold",
                    format_number(share));
    double before_k = 1, before = most;
    for (int step = 0; step < kShownSteps; ++step) {
        const double now = shown_mm(script_at(k), folder, place) / full_mm;
        if (std::abs(now - share) <= kShown || !(now > 0)) break;
        double slope = 1;
        if (k != before_k && now != before) slope = std::log(before / now) / std::log(before_k / k);
        const double next = rounded(
            std::clamp(k * std::pow(share / now, 1 / std::clamp(slope, 0.2, 5.0)), 1e-4, 1.0));
        before_k = k;
        before = now;
        if (next == k) break;
        k = next;
    }
    return k;
}

}  // namespace risorius::stimuli
