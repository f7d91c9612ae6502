// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/chin.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace risorius::landmarks {

namespace {

// The length of the profile from the pogonion to the menton, as shares of the distances from the sublabiale and from the hyoid to the
// pogonion. Fitted to 74 heads: docs/decisions/0091
constexpr double kOfChin = 1.98, kOfThroat = 0.313;
constexpr double kFarthest_m =
    7e-3;  // from the comparison, which on those heads was off by up to 6.5 mm
constexpr double kMiddleAbove_m = 5e-3, kMiddleBehind_m = 5e-3;  // of the fan, from pg and from me
constexpr double kFanRadius_m = 50e-3, kFanStep_deg = 0.5, kFanBehind_deg = -110;

/// A line of points, and where along it the point nearest to another one is.
struct Profile {
    std::vector<Vec3> points;
    std::vector<double> along;

    double nearest(const Vec3& p) const {
        std::size_t best = 0;
        for (std::size_t i = 1; i < points.size(); ++i)
            if ((points[i] - p).norm() < (points[best] - p).norm()) best = i;
        return along[best];
    }
};

/// The profile of the chin from the pogonion downwards, as rays towards a place within it meet it.
Profile chin_profile(const ShownHead& head, const Vec3& pogonion, const Vec3& menton) {
    const Vec3 middle(menton.x() + 1e-5, pogonion.y() + kMiddleAbove_m,
                      menton.z() - kMiddleBehind_m);
    const double first_deg =
        std::atan2(pogonion.y() - middle.y(), pogonion.z() - middle.z()) * 180 / std::numbers::pi;
    Profile out;
    for (double deg = first_deg; deg > kFanBehind_deg; deg -= kFanStep_deg) {
        const double angle = deg * std::numbers::pi / 180;
        const Vec3 outwards(0, std::sin(angle), std::cos(angle));
        const auto hit = head.skin_tree.cast(middle + kFanRadius_m * outwards, -outwards);
        if (!hit || (hit->point - middle).dot(outwards) < 0) break;
        out.along.push_back(
            out.points.empty() ? 0 : out.along.back() + (hit->point - out.points.back()).norm());
        out.points.push_back(hit->point);
    }
    return out;
}

}  // namespace

std::optional<Vec3> menton_by_profile(const ShownHead& head, const ChinLandmarks& at) {
    const Profile profile = chin_profile(head, at.pogonion, at.menton);
    if (profile.points.empty()) return std::nullopt;
    const double compared = profile.nearest(at.menton),
                 usual = kOfChin * (at.sublabiale - at.pogonion).norm() +
                         kOfThroat * (at.hyoid - at.pogonion).norm(),
                 length = std::clamp(usual, compared - kFarthest_m, compared + kFarthest_m);
    for (std::size_t i = 1; i < profile.points.size(); ++i)
        if (profile.along[i] >= length) {
            const double share =
                (length - profile.along[i - 1]) / (profile.along[i] - profile.along[i - 1]);
            return (1 - share) * profile.points[i - 1] + share * profile.points[i];
        }
    return std::nullopt;
}

}  // namespace risorius::landmarks
