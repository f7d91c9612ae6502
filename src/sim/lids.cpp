#include "sim/lids.h"

#include <algorithm>
#include <cmath>

#include "sim/polyline.h"

namespace risorius::sim {

EyeLids::EyeLids(const rig::Head& head, int side, double upper_share) : upper_share_(upper_share) {
    const std::string suffix = side == 0 ? "_l" : "_r";
    const auto at = [&](const char* id) { return head.landmark(id + suffix); };
    centre_ = head.eyes[side].centre;
    axis_ = (at("ex") - at("en")).normalized();
    // The lids turn about the eye, so their axis passes through its centre; level it to the canthi's own direction.
    const Vec3 gaze = head.eyes[side].forward;
    forward_ = (gaze - gaze.dot(axis_) * axis_).normalized();
    up_ = forward_.cross(axis_);
    if (up_.y() < 0) up_ = -up_;
    inner_ = (at("en") - centre_).dot(axis_);
    outer_ = (at("ex") - centre_).dot(axis_);
    fissure_m_ = outer_ - inner_;
    zone_m_ = 0.5 * ((at("en") - centre_).norm() + (at("ex") - centre_).norm());
    upper_ = sample_curve({at("en"), at("ulm"), at("ps"), at("ull"), at("ex")}, head.mm(0.5));
    lower_ = sample_curve({at("en"), at("llm"), at("pi"), at("lll"), at("ex")}, head.mm(0.5));
}

double EyeLids::place_of(const Vec3& p) const {
    return ((p - centre_).dot(axis_) - inner_) / (outer_ - inner_);
}

double EyeLids::angle_of(const Vec3& p) const {
    const Vec3 r = p - centre_;
    return std::atan2(r.dot(up_), r.dot(forward_));
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

double EyeLids::margin_distance(const Vec3& p) const {
    return std::min(distance_to_polyline(p, upper_), distance_to_polyline(p, lower_));
}

LidMember EyeLids::classify(const Vec3& p, double core_m, double upper_fade_m,
                            double lower_fade_m) const {
    const double place = place_of(p);
    const double upper_distance = distance_to_polyline(p, upper_);
    const double lower_distance = distance_to_polyline(p, lower_);
    const double middle = 0.5 * (margin_angle(upper_, place) + margin_angle(lower_, place));
    LidMember member{-1, angle_of(p) >= middle, 0.0, place};
    const double distance = member.upper ? upper_distance : lower_distance;
    const double fade = member.upper ? upper_fade_m : lower_fade_m;
    const double s = std::clamp(place, 0.0, 1.0);
    const double canthus = std::pow(std::sin(3.14159265358979323846 * s), 0.6);
    member.weight = (1.0 - smoothstep(core_m, core_m + fade, distance)) * canthus;
    return member;
}

Vec3 EyeLids::ride(const Vec3& rest, bool upper, double place, const LidPose& pose) const {
    const double top = margin_angle(upper_, place), bottom = margin_angle(lower_, place);
    const double gap = std::max(0.0, top - bottom);
    double turn = 0.0;  // about the axis, positive up
    if (upper) {
        turn = -pose.upper_closure * upper_share_ * gap - pose.upper_gaze_rad;
    } else {
        turn = pose.lower_closure * (1.0 - upper_share_) * gap - pose.lower_gaze_rad;
    }
    // Turning forward_ towards up_ is a rotation about forward_ x up_.
    const Vec3 r = rest - centre_;
    return Eigen::AngleAxisd(turn, forward_.cross(up_)) * r - r;
}

}  // namespace risorius::sim
