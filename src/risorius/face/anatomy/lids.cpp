// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/lids.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr int kPlaces = 121;  // samples of the tables over s
constexpr double kFirstPlace = -0.25, kLastPlace = 1.25;
constexpr double kLowest = -1.3, kAngle = 0.002;  // rad, range and step of the scan for the fissure
constexpr int kAngles = 1200;

double place_at(int i) { return kFirstPlace + (kLastPlace - kFirstPlace) * i / (kPlaces - 1); }

}  // namespace

EyeLids::EyeLids(const rig::Head& head, int side, double upper_fraction)
    : upper_fraction_(upper_fraction), to_left_(side == 0 ? 1.0 : -1.0), millimetre_(head.mm(1)) {
    const std::string suffix = side == 0 ? "_l" : "_r";
    const auto at = [&](const char* id) { return head.landmark(id + suffix); };
    centre_ = head.eyes[side].centre;
    axis_ = (at("ex") - at("en")).normalized();
    // The lids rotate about the eye, so their axis passes through its centre, parallel to the line through the canthi
    const Vec3 gaze = head.eyes[side].forward;
    forward_ = (gaze - gaze.dot(axis_) * axis_).normalized();
    up_ = forward_.cross(axis_);
    if (up_.y() < 0) up_ = -up_;
    inner_ = (at("en") - centre_).dot(axis_);
    outer_ = (at("ex") - centre_).dot(axis_);
    fissure_m_ = outer_ - inner_;
    zone_m_ = 0.5 * ((at("en") - centre_).norm() + (at("ex") - centre_).norm());
    upper_ = geom::sample_curve({at("en"), at("ulm"), at("ps"), at("ull"), at("ex")}, head.mm(0.5));
    lower_ = geom::sample_curve({at("en"), at("llm"), at("pi"), at("lll"), at("ex")}, head.mm(0.5));
    measure_margins(head);
    widen_gap();
    const double arc = head.mm(1) / head.eyes[side].radius_m;
    crease_angle_ =
        std::clamp(angle_of(at("ucr")), upper_angle(0.5) + 4.0 * arc, upper_angle(0.5) + 7.0 * arc);
    lower_reach_m_ = head.mm(9);
}

double EyeLids::place_of(const Vec3& p) const {
    return ((p - centre_).dot(axis_) - inner_) / (outer_ - inner_);
}

double EyeLids::angle_of(const Vec3& p) const {
    const Vec3 r = p - centre_;
    return std::atan2(r.dot(up_), r.dot(forward_));
}

double EyeLids::at(const std::vector<double>& table, double place) const {
    const double x =
        std::clamp((place - kFirstPlace) / (kLastPlace - kFirstPlace), 0.0, 1.0) * (kPlaces - 1);
    const int i = std::min(static_cast<int>(x), kPlaces - 2);
    return (1 - (x - i)) * table[i] + (x - i) * table[i + 1];
}

double EyeLids::margin_angle(const std::vector<Vec3>& margin, double place) const {
    const double s = std::clamp(place, 0.0, 1.0);
    for (std::size_t i = 0; i + 1 < margin.size(); ++i) {
        const double a = place_of(margin[i]), b = place_of(margin[i + 1]);
        if (s < a || s > b || b <= a) continue;
        const double t = (s - a) / (b - a);
        return (1 - t) * angle_of(margin[i]) + t * angle_of(margin[i + 1]);
    }
    return angle_of(s < 0.5 ? margin.front() : margin.back());
}

// Measures the fissure as seen from the centre of the eye: at each s the largest interval of angles that no triangle covers. A mesh with
// closed eyes has none; there the landmarks give the margins.
void EyeLids::measure_margins(const rig::Head& head) {
    std::vector<std::vector<char>> covered(kPlaces, std::vector<char>(kAngles, 0));
    const double reach = zone_m_ + head.mm(10);
    for (const Triangles* triangles : {&head.skin, &head.lining})
        for (long f = 0; f < triangles->rows(); ++f) {
            std::array<double, 3> place, angle;
            bool near = true;
            for (int k = 0; k < 3 && near; ++k) {
                const Vec3 p = head.vertices.row((*triangles)(f, k)).transpose();
                near = (p - centre_).norm() < reach && (p - centre_).dot(forward_) > 0;
                place[k] = place_of(p);
                angle[k] = angle_of(p);
            }
            if (!near) continue;
            for (int i = 0; i < kPlaces; ++i) {
                double low = 1e9, high = -1e9;
                for (int k = 0; k < 3; ++k) {
                    const int l = (k + 1) % 3;
                    if ((place[k] <= place_at(i)) == (place[l] <= place_at(i))) continue;
                    const double t = (place_at(i) - place[k]) / (place[l] - place[k]);
                    low = std::min(low, angle[k] + t * (angle[l] - angle[k]));
                    high = std::max(high, angle[k] + t * (angle[l] - angle[k]));
                }
                const int from = std::max(0, static_cast<int>(std::ceil((low - kLowest) / kAngle)));
                const int to = std::min(
                    kAngles - 1, static_cast<int>((std::max(high, kLowest) - kLowest) / kAngle));
                for (int a = from; a <= to; ++a) covered[i][a] = 1;
            }
        }

    upper_angle_.assign(kPlaces, 0.0);
    lower_angle_.assign(kPlaces, 0.0);
    std::vector<char> open(kPlaces, 0);
    constexpr double kMinOpening = 0.012;  // rad, about 0.15 mm
    for (int i = 0; i < kPlaces; ++i) {
        const double middle =
            0.5 * (margin_angle(upper_, place_at(i)) + margin_angle(lower_, place_at(i)));
        int longest = 0, end = 0, run = 0;
        for (int a = 0; a < kAngles; ++a) {
            run = covered[i][a] || std::abs(kLowest + a * kAngle - middle) > 0.75 ? 0 : run + 1;
            if (run > longest) {
                longest = run;
                end = a;
            }
        }
        open[i] = longest * kAngle > kMinOpening;
        lower_angle_[i] = kLowest + (end - longest + 0.5) * kAngle;
        upper_angle_[i] = kLowest + (end + 0.5) * kAngle;
    }
    // The one opening that contains the middle
    int first = kPlaces / 2, last = kPlaces / 2;
    while (first > 0 && open[first - 1]) --first;
    while (last + 1 < kPlaces && open[last + 1]) ++last;
    const bool found = open[kPlaces / 2] && (last - first) > kPlaces / 4;
    // Near the canthi the caruncle and folds of skin hide part of the opening; the landmarks give it there
    for (int i = 0; i < kPlaces; ++i) {
        const double s = place_at(i);
        const double upper = margin_angle(upper_, s), lower = margin_angle(lower_, s);
        const bool measured = found && i >= first && i <= last;
        const double end = geom::smoothstep(0.1, 0.22, std::abs(s - 0.5));
        if (!measured) {
            upper_angle_[i] = upper;
            lower_angle_[i] = std::min(upper, lower);
        }
        upper_angle_[i] += end * std::max(0.0, upper - upper_angle_[i]);
        lower_angle_[i] += end * std::min(0.0, lower - lower_angle_[i]);
    }
}

// Skin above the margin does not end at the canthi like the fissure. It rotates by the gap averaged along the lid.
void EyeLids::widen_gap() {
    constexpr double kWidth = 0.13;  // width of the mean / length of the fissure
    wide_gap_.assign(kPlaces, 0.0);
    for (int i = 0; i < kPlaces; ++i) {
        double sum = 0, weights = 0;
        for (int j = -kPlaces; j < 2 * kPlaces; ++j) {
            const double off = (place_at(j) - place_at(i)) / kWidth;
            const double w = std::exp(-0.5 * off * off);
            weights += w;
            if (j >= 0 && j < kPlaces) sum += w * (upper_angle_[j] - lower_angle_[j]);
        }
        wide_gap_[i] = sum / weights;
    }
}

double EyeLids::beyond_m(double place) const {
    return fissure_m_ * std::max({0.0, -place, place - 1.0});
}

double EyeLids::margin_distance(const Vec3& p) const {
    return std::min(geom::distance_to_polyline(p, upper_), geom::distance_to_polyline(p, lower_));
}

LidMember EyeLids::member(const Vec3& p) const {
    LidMember member;
    member.place = place_of(p);
    const double angle = angle_of(p);
    const double upper = upper_angle(member.place), lower = lower_angle(member.place);
    member.upper = angle >= 0.5 * (upper + lower);
    const Vec3 r = p - centre_;
    const double from_axis = (r - r.dot(axis_) * axis_).norm();
    // A crease near the margin still leaves some skin on the lid
    const double min = 3.0 * millimetre_ / std::max(from_axis, 3.0 * millimetre_);
    member.height = member.upper
                        ? std::max(0.0, angle - upper) / std::max(crease_angle_ - upper, min)
                        : std::max(0.0, lower - angle) * from_axis / lower_reach_m_;
    member.beyond = beyond_m(member.place);
    // Points between the lids (the caruncle) follow both; beyond the canthi the upper lid merges into the lower lid
    const double middle = 0.5 * (upper + lower);
    const double half = std::max(
        {0.5 * (upper - lower), 1e-6, 0.4 * geom::smoothstep(0, 2.0 * millimetre_, member.beyond)});
    const double between = std::clamp(0.5 + 0.5 * (angle - middle) / half, 0.0, 1.0);
    member.fraction = member.beyond > 0 ? geom::smoothstep(0.0, 1.0, between) : between;
    return member;
}

double EyeLids::firmness(const LidMember& member, double upper_core, double upper_end,
                         double lower_core, double lower_end) {
    constexpr double kBeyond_m = 2.5e-3;
    const double along = 1.0 - geom::smoothstep(0.0, kBeyond_m, member.beyond);
    return along * (member.upper ? 1.0 - geom::smoothstep(upper_core, upper_end, member.height)
                                 : 1.0 - geom::smoothstep(lower_core, lower_end, member.height));
}

// At the canthi both lids rotate alike, by less than half of the way.
double EyeLids::gaze_turn(double place, double own_rad, double other_rad) const {
    const double s = std::clamp(place, 0.0, 1.0);
    const double apart = std::sqrt(std::sin(std::numbers::pi * s));
    const double together = 0.75 * 0.5 * (own_rad + other_rad);
    return (together + apart * (own_rad - together)) *
           (1.0 - geom::smoothstep(0, 7.0 * millimetre_, beyond_m(place)));
}

EyeLids::Curves EyeLids::curves(double place, const LidPose& pose) const {
    const double gap = upper_angle(place) - lower_angle(place);
    const double lower = lower_angle(place) + pose.lower_lift * gap -
                         gaze_turn(place, pose.lower_gaze_rad, pose.upper_gaze_rad);
    const double upper = std::max(
        lower, upper_angle(place) - gaze_turn(place, pose.upper_gaze_rad, pose.lower_gaze_rad));
    const double meeting = lower + (1.0 - upper_fraction_) * (upper - lower);
    // Closed lids press their margins into each other; otherwise a coarse mesh would leave slits
    const double press = 0.08 * millimetre_ / zone_m_;
    return {upper + pose.upper_closure * (meeting - press - upper),
            lower + pose.lower_closure * (meeting + press - lower)};
}

// In measured blinks the lower lid slides 3 mm inwards, most in the middle, and the upper lid 2.2 mm, most near the nose.
double EyeLids::slide_m(double place, bool upper, const LidPose& pose) const {
    if (pose.inward == 0 && pose.aside_rad == 0) return 0.0;
    const double s = std::clamp(place, 0.0, 1.0);
    const double inward = upper ? 2.2 * std::sin(std::numbers::pi * std::pow(s, 0.6))
                                : 3.0 * std::sin(std::numbers::pi * std::pow(s, 0.75));
    const double aside = pose.aside_rad * zone_m_ * (0.5 + 0.5 * std::sin(std::numbers::pi * s)) *
                         (1.0 - geom::smoothstep(0, 7.0 * millimetre_, beyond_m(place)));
    return -pose.inward * inward * millimetre_ + to_left_ * aside;
}

double EyeLids::upper_turn(const LidMember& member, const LidPose& pose) const {
    const double s = member.place, q = member.height;
    const double gaze = -gaze_turn(s, pose.upper_gaze_rad, pose.lower_gaze_rad);
    const double moved = s + slide_m(s, true, pose) / fissure_m_;
    const double margin = curves(moved, pose).upper - upper_angle(s) - gaze;
    const double above = -pose.upper_closure * upper_fraction_ * at(wide_gap_, s);
    const double over = geom::smoothstep(0.0, 0.4, q);
    const double unrolls = 1.0 - geom::smoothstep(0.08, 1.1, q);
    const double plate = (1.0 - 0.2 * std::min(1.0, q)) * (1.0 - geom::smoothstep(0.75, 1.25, q));
    return ((1 - over) * margin + over * above) * unrolls + gaze * plate;
}

double EyeLids::lower_turn(const LidMember& member, const LidPose& pose) const {
    const double s = member.place;
    const double moved = s + slide_m(s, false, pose) / fissure_m_;
    return (curves(moved, pose).lower - lower_angle(s)) *
           (1.0 - geom::smoothstep(0.0, 1.0, member.height));
}

Vec3 EyeLids::ride(const Vec3& rest, const LidMember& member, const LidPose& pose) const {
    double turn = 0.0, slide = 0.0;  // about the axis, positive up; along it
    if (member.fraction > 0) {
        turn += member.fraction * upper_turn(member, pose);
        slide += member.fraction * slide_m(member.place, true, pose) *
                 (1.0 - geom::smoothstep(0.08, 1.2, member.upper ? member.height : 0.0));
    }
    if (member.fraction < 1) {
        turn += (1 - member.fraction) * lower_turn(member, pose);
        slide += (1 - member.fraction) * slide_m(member.place, false, pose) *
                 (1.0 - geom::smoothstep(0.0, 1.0, member.upper ? 0.0 : member.height));
    }
    if (turn == 0.0 && slide == 0.0) return Vec3::Zero();
    // Turning forward_ towards up_ is a rotation about forward_ x up_.
    const Vec3 r = rest - centre_;
    return Eigen::AngleAxisd(turn, forward_.cross(up_)) * r + slide * axis_ - r;
}

}  // namespace risorius::face
