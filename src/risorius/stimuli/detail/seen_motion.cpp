// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/seen_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/core/rotations.h"

namespace risorius::stimuli {

namespace {

// Half a pixel in a picture of 512 pixels, and 100 times the accuracy of a simulation step
constexpr double kOnset_mm = 0.3, kOnsetFraction = 0.05;
constexpr double kApexFraction = 0.99;  // a held face still moves by micrometres
constexpr double kNoMovement_mm = 0.1;  // less is no movement
constexpr double kBlinkFraction = 0.8, kGaze_deg = 1;
constexpr std::array kSkull{"v",   "op",   "eu_l", "eu_r",  "t_l",
                            "t_r", "sa_l", "sa_r", "sba_l", "sba_r"};
constexpr std::array kNeck{"cer", "hyo"};

template <typename Ids>
bool is_one_of(const Ids& ids, const std::string& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// The landmarks of a table of frames.
animate::LandmarkFrames landmarks_of(const animate::FrameRows& rows) {
    animate::LandmarkFrames out;
    std::vector<int> columns;
    const std::string x = ".x_mm";
    for (std::size_t c = 0; c + 2 < rows.names.size(); ++c)
        if (const std::string& name = rows.names[c]; name.ends_with(x)) {
            out.ids.push_back(name.substr(0, name.size() - x.size()));
            columns.push_back(static_cast<int>(c));
        }
    for (int r = 0; r < rows.rows(); ++r) {
        Points& points =
            out.positions_mm.emplace_back(static_cast<Eigen::Index>(columns.size()), 3);
        for (std::size_t i = 0; i < columns.size(); ++i)
            for (int k = 0; k < 3; ++k)
                points(static_cast<Eigen::Index>(i), k) = rows.number(r, columns[i] + k);
    }
    return out;
}

std::vector<Eigen::Index> rows_of_skull(const std::vector<std::string>& ids) {
    std::vector<Eigen::Index> out;
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (is_one_of(kSkull, ids[i])) out.push_back(static_cast<Eigen::Index>(i));
    return out;
}

/// All frames in the frame of the head at `first`.
std::vector<Points> without_head(const animate::LandmarkFrames& frames, int first) {
    std::vector<Points> out = frames.positions_mm;
    const std::vector<Eigen::Index> skull = rows_of_skull(frames.ids);
    if (skull.size() < 3) return out;  // nothing tells how the head moves
    const auto fixed_points = [&](const Points& of) {
        Points points(static_cast<Eigen::Index>(skull.size()), 3);
        for (std::size_t i = 0; i < skull.size(); ++i)
            points.row(static_cast<Eigen::Index>(i)) = of.row(skull[i]);
        return points;
    };
    const Points to = fixed_points(frames.positions_mm[static_cast<std::size_t>(first)]);
    for (Points& points : out) {
        const Points from = fixed_points(points);
        if (from == to) continue;
        const Rigid fit = nearest_motion(from, to);
        points = (points * fit.linear().transpose()).rowwise() + fit.translation().transpose();
    }
    return out;
}

/// The first shown frame for which `holds` is true of its row.
template <typename Holds>
std::optional<int> first_shown(const std::vector<int>& order, const Holds& holds) {
    for (std::size_t t = 0; t < order.size(); ++t)
        if (holds(order[t])) return static_cast<int>(t);
    return {};
}

/// The first shown frame in which the lids of the twin close: those of the face also narrow in a smile.
std::optional<int> blink_onset(const animate::LandmarkFrames& twin, const std::vector<int>& order) {
    const auto row_of = [&](const char* id) {
        const auto found = std::find(twin.ids.begin(), twin.ids.end(), id);
        return found == twin.ids.end() ? Eigen::Index(-1) : found - twin.ids.begin();
    };
    const std::array rows{row_of("ps_l"), row_of("pi_l"), row_of("ps_r"), row_of("pi_r")};
    if (std::find(rows.begin(), rows.end(), -1) != rows.end()) return {};
    const auto aperture = [&](int frame) {
        const Points& at = twin.positions_mm[static_cast<std::size_t>(frame)];
        return std::min((at.row(rows[0]) - at.row(rows[1])).norm(),
                        (at.row(rows[2]) - at.row(rows[3])).norm());
    };
    return first_shown(order, [&](int frame) {
        return aperture(frame) < kBlinkFraction * aperture(order.front());
    });
}

/// s, and whose it is.
struct Way {
    double mm = 0;
    std::string landmark;
};

Way way_between(const std::vector<std::string>& ids, const LandmarkChoice& choice,
                const Points& from, const Points& to, const Points* twin_from,
                const Points* twin_to) {
    Way out;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (is_one_of(kSkull, ids[i]) || is_one_of(kNeck, ids[i]) || !choice.has(ids[i])) continue;
        const auto row = static_cast<Eigen::Index>(i);
        Vec3 way = (to.row(row) - from.row(row)).transpose();
        if (twin_from) way -= (twin_to->row(row) - twin_from->row(row)).transpose();
        if (const double mm = way.norm(); mm > out.mm) out = {mm, ids[i]};
    }
    return out;
}

void find_moments(const std::vector<double>& s, bool in_time_order, int fps, SeenMotion& out) {
    const double limit = std::min(kOnset_mm, kOnsetFraction * *out.seen_mm);
    double rise = 0;
    for (std::size_t t = 0; t < s.size(); ++t) {
        const int frame = static_cast<int>(t);
        if (!out.onset && s[t] > limit) out.onset = frame;
        if (!out.apex && s[t] >= kApexFraction * *out.seen_mm) out.apex = frame;
        if (out.apex && !out.offset && in_time_order && s[t] < limit) out.offset = frame;
        if (t > 0) rise = std::max(rise, s[t] - s[t - 1]);
    }
    out.velocity_peak_mm_s = rise * fps;
}

bool is_in_time_order(const std::vector<int>& order) {
    return std::is_sorted(order.begin(), order.end()) ||
           std::is_sorted(order.rbegin(), order.rend());
}

void find_other_onsets(const animate::FrameRows& rows, const animate::LandmarkFrames& landmarks,
                       const std::vector<int>& order, SeenMotion& out) {
    const int first = order.front();
    const std::vector<Eigen::Index> skull = rows_of_skull(landmarks.ids);
    out.head_onset = first_shown(order, [&](int row) {
        const Points& now = landmarks.positions_mm[static_cast<std::size_t>(row)];
        const Points& then = landmarks.positions_mm[static_cast<std::size_t>(first)];
        return std::any_of(skull.begin(), skull.end(), [&](Eigen::Index i) {
            return (now.row(i) - then.row(i)).norm() > kOnset_mm;
        });
    });
    std::vector<int> gaze;
    for (const char* name :
         {"gaze_yaw_deg.l", "gaze_yaw_deg.r", "gaze_pitch_deg.l", "gaze_pitch_deg.r"})
        if (const int column = rows.column(name); column >= 0) gaze.push_back(column);
    out.gaze_onset = first_shown(order, [&](int row) {
        return std::any_of(gaze.begin(), gaze.end(), [&](int column) {
            return std::abs(rows.number(row, column) - rows.number(first, column)) > kGaze_deg;
        });
    });
}

}  // namespace

std::string LandmarkChoice::name() const {
    std::string out;
    if (ids_)
        for (const std::string& id : *ids_) out += id + " ";
    return out;
}

SeenMotion seen_motion(const animate::FrameRows& rows,
                       const std::optional<animate::LandmarkFrames>& twin,
                       const std::vector<int>& order, int fps, const LandmarkChoice& choice) {
    SeenMotion out;
    const bool still =
        std::all_of(order.begin(), order.end(), [&](int frame) { return frame == order.front(); });
    if (order.empty() || still) return out;
    const animate::LandmarkFrames landmarks = landmarks_of(rows);
    const int first = order.front();
    const std::vector<Points> q = without_head(landmarks, first);
    std::vector<Points> q_twin;
    if (twin) q_twin = without_head(*twin, first);
    std::vector<double> s;
    Way farthest;
    for (const int frame : order) {
        const auto now = static_cast<std::size_t>(frame), then = static_cast<std::size_t>(first);
        const Way way = way_between(landmarks.ids, choice, q[then], q[now],
                                    twin ? &q_twin[then] : nullptr, twin ? &q_twin[now] : nullptr);
        s.push_back(way.mm);
        if (way.mm > farthest.mm) farthest = way;
    }
    out.way_mm = s;
    find_other_onsets(rows, landmarks, order, out);
    if (twin) out.blink_onset = blink_onset(*twin, order);
    const bool moves = farthest.mm >= kNoMovement_mm;
    if (!moves && !out.head_onset && !out.blink_onset && !out.gaze_onset) return out;
    out.seen_mm = farthest.mm;
    out.landmark = farthest.landmark;
    if (moves) find_moments(s, is_in_time_order(order), fps, out);
    return out;
}

SeenMotion seen_together(const SeenMotion& a, const SeenMotion& b, const std::vector<int>& order,
                         int fps) {
    SeenMotion out = a;
    out.full_mm = {};
    out.onset = out.apex = out.offset = {};
    out.velocity_peak_mm_s = {};
    const SeenMotion& farther = b.seen_mm.value_or(0) > a.seen_mm.value_or(0) ? b : a;
    out.landmark = farther.landmark;
    out.way_mm.resize(std::max(a.way_mm.size(), b.way_mm.size()));
    for (std::size_t t = 0; t < out.way_mm.size(); ++t)
        out.way_mm[t] = std::max(t < a.way_mm.size() ? a.way_mm[t] : 0.0,
                                 t < b.way_mm.size() ? b.way_mm[t] : 0.0);
    const double most = farther.seen_mm.value_or(0);
    const bool moves = most >= kNoMovement_mm;
    if (moves || out.head_onset || out.blink_onset || out.gaze_onset)
        out.seen_mm = most;
    else
        out.seen_mm = {};
    if (moves) find_moments(out.way_mm, is_in_time_order(order), fps, out);
    return out;
}

SeenPicture seen_picture(const animate::LandmarkFrames& frames,
                         const std::optional<animate::LandmarkFrames>& twin,
                         std::optional<int> frame, const LandmarkChoice& choice) {
    const std::vector<Points> q = without_head(frames, 0);
    std::vector<Points> q_twin;
    if (twin) q_twin = without_head(*twin, 0);
    std::vector<Way> ways;
    for (std::size_t now = 0; now < q.size(); ++now)
        ways.push_back(way_between(frames.ids, choice, q[0], q[now], twin ? &q_twin[0] : nullptr,
                                   twin ? &q_twin[now] : nullptr));
    if (!frame) {
        double most = 0;
        for (const Way& way : ways) most = std::max(most, way.mm);
        const auto apex = std::find_if(ways.begin(), ways.end(), [&](const Way& way) {
            return most < kNoMovement_mm || way.mm >= kApexFraction * most;
        });
        frame = static_cast<int>(apex - ways.begin());
    }
    const Way& shown = ways[static_cast<std::size_t>(*frame)];
    return {*frame, shown.mm, shown.landmark};
}

double largest_way_mm(const animate::LandmarkFrames& frames, const LandmarkChoice& choice) {
    const std::vector<Points> q = without_head(frames, 0);
    return way_between(frames.ids, choice, q[0], q[1], nullptr, nullptr).mm;
}

Json json_of(const SeenMotion& motion, std::optional<int> pixel_onset) {
    const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(); };
    const bool still = !motion.seen_mm;
    return json_object({{"seen_mm", or_null(motion.seen_mm)},
                        {"seen_landmark", motion.landmark.empty() ? Json() : Json(motion.landmark)},
                        {"full_mm", or_null(motion.full_mm)},
                        {"seen_onset_frame", or_null(motion.onset)},
                        {"seen_apex_frame", or_null(motion.apex)},
                        {"seen_offset_frame", or_null(motion.offset)},
                        {"velocity_peak_mm_s", or_null(motion.velocity_peak_mm_s)},
                        {"pixel_onset_frame", still ? Json() : or_null(pixel_onset)},
                        {"head_onset_frame", or_null(motion.head_onset)},
                        {"blink_onset_frame", or_null(motion.blink_onset)},
                        {"gaze_onset_frame", or_null(motion.gaze_onset)}});
}

}  // namespace risorius::stimuli
