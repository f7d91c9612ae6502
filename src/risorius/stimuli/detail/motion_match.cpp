// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/motion_match.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/stimuli/detail/expression_script.h"
#include "risorius/stimuli/detail/known_motion.h"

namespace risorius::stimuli {

namespace {

constexpr double kSettled = 0.005, kShown = 0.01;  // accepted differences of shares
constexpr int kSettledSteps = 10, kShownSteps = 4;
constexpr double kLeast_mm = 0.1;
constexpr double kApex = 0.99;         // share of the maximum, as in seen_motion.h
constexpr double kNear = 0.3;          // accepted difference of times / frame
constexpr double kShortest_s = 0.001;  // of a rise
constexpr int kTimeSteps = 12;

animate::RenderJob job_of(const Json& script, const std::filesystem::path& folder,
                          const std::string& quality, const std::string& place,
                          animate::RenderInputs& inputs) {
    animate::RenderRequest request;
    // Its relative paths start in the folder, so that the place must not look like a path.
    std::string name = "script of" + place.substr(place.find(":/") + 1);
    std::replace(name.begin(), name.end(), '/', ' ');
    request.script = folder / name;
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
    return known_[key] = settled_way_mm(job_of(*settled, folder, quality_, place, inputs_),
                                        session_, [&] { report(place); });
}

void MotionMatch::report(const std::string& place) const {
    const double done = static_cast<double>(begun_ - 1) / static_cast<double>(searches_);
    monitor_.report(std::clamp(done, 0.0, 1.0),
                    "equal motion: " + place.substr(place.find(":/") + 1));
}

double MotionMatch::Course::most_mm() const {
    return way_mm.empty() ? 0 : *std::max_element(way_mm.begin(), way_mm.end());
}

double MotionMatch::Course::apex_s() const {
    const double limit = kApex * most_mm();
    for (std::size_t frame = 1; frame < way_mm.size(); ++frame)
        if (way_mm[frame] >= limit) {
            const double rise = way_mm[frame] - way_mm[frame - 1];
            const double before = rise > 0 ? (limit - way_mm[frame - 1]) / rise : 1;
            return (static_cast<double>(frame) - 1 + std::clamp(before, 0.0, 1.0)) / fps;
        }
    return 0;
}

const MotionMatch::Course& MotionMatch::course_of(const Json& script,
                                                  const std::filesystem::path& folder,
                                                  const std::string& place) {
    const std::optional<Json> alone = expression_alone(script);
    const std::string key = (alone ? json_text(*alone) : std::string()) + folder.string();
    if (const auto found = courses_.find(key); found != courses_.end()) return found->second;
    Course course;
    if (alone) {
        const animate::RenderJob job = job_of(*alone, folder, quality_, place, inputs_);
        course.fps = job.fps;
        course.way_mm = course_mm(job, session_, monitor_, [&] { report(place); });
    }
    return courses_[key] = std::move(course);
}

double MotionMatch::time_for(double apex_s, const std::function<Json(double)>& script_at,
                             const std::filesystem::path& folder, const std::string& place) {
    ++begun_;
    const auto course_at = [&](double time_s) -> const Course& {
        return course_of(script_at(time_s), folder, place);
    };
    double low_s = kShortest_s, high_s = apex_s;
    const Course longest = course_at(high_s);
    if (longest.most_mm() < kLeast_mm)
        throw Error(place, "a script with a movement, for match/motion/apex_s",
                    "one that moves the face by " + format_number(longest.most_mm()) + " mm");
    // The apex is in the first frame after c. So c is wanted in the middle of the time before that frame.
    const double frame_s = 1.0 / longest.fps;
    const double wanted_s = (std::round(apex_s / frame_s) - 0.5) * frame_s;
    const auto away_s = [&](double time_s) { return course_at(time_s).apex_s() - wanted_s; };
    double f_low = away_s(low_s), f_high = away_s(high_s);
    if (std::abs(f_low) <= kNear * frame_s) return low_s;
    if (f_low > 0)
        throw Error(place,
                    "an apex_s of match/motion of " +
                        format_number(std::ceil(1000 * (f_low + wanted_s + frame_s / 2)) / 1000) +
                        " s or later",
                    format_number(apex_s));
    if (f_high < 0)
        throw Error(place,
                    "a script whose movement is at its apex as late as apex_s of match/motion",
                    "an apex at " + format_number(std::floor(1000 * (f_high + wanted_s)) / 1000) +
                        " s for a rise of " + format_number(high_s) + " s");
    double time_s = high_s;
    int last_side = 0;
    for (int step = 0; step < kTimeSteps; ++step) {
        time_s = rounded(low_s + (high_s - low_s) * -f_low / (f_high - f_low));
        const double f = away_s(time_s);
        if (std::abs(f) <= kNear * frame_s) return time_s;
        const int side = f < 0 ? -1 : 1;
        (f < 0 ? low_s : high_s) = time_s;
        (f < 0 ? f_low : f_high) = f;
        if (side == last_side) (f < 0 ? f_high : f_low) /= 2;
        last_side = side;
    }
    throw Error(place, "a rise whose apex can be moved to " + format_number(apex_s) + " s",
                "none after " + std::to_string(kTimeSteps) + " tries; the last was " +
                    format_number(time_s) + " s");
}

double MotionMatch::intensity_for(double share, const std::function<Json(double)>& script_at,
                                  const std::filesystem::path& folder, const std::string& place) {
    ++begun_;
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
    const double most = course_of(script_at(1), folder, place).most_mm() / full_mm;
    if (most < share - 2 * kShown)
        throw Error(place,
                    "a share of match/motion of at most " +
                        format_number(std::floor(100 * most) / 100) + ", or a longer onset or hold",
                    format_number(share));
    double before_k = 1, before = most;
    for (int step = 0; step < kShownSteps; ++step) {
        const double now = course_of(script_at(k), folder, place).most_mm() / full_mm;
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
