// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/by_definition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace risorius::landmarks {

namespace {

constexpr double kStep_m = 0.2e-3;    // between rays
constexpr double kTurnOver_m = 2e-3;  // length over which a turn of the skin is measured
constexpr double kAbove_m = 4e-3;     // rows above and below a corner
constexpr double kInside_m = 6e-3;    // how far from a corner the crease is surely there
constexpr double kOutside_m = 7e-3;   // how far out a corner is looked for
constexpr double kDeepest_m = 3e-3;   // of a crease behind the guess
constexpr double kBefore_m = 25e-3;   // where rays start
constexpr int kEndedColumns = 5;      // so many without a crease end it
constexpr double kBeside_m = 1e-5;
constexpr double kOpen_deg = 180;  // turn where no skin is seen

struct Corner {
    const char* id;
    double outwards;   // along x: of the subject's left, +1
    double least_deg;  // a smaller turn is no crease between lids or lips
    double beyond_m;   // how far such a crease goes on behind the corner
};
// Measured on ICT-FaceKit, MakeHuman and the adult: docs/decisions/0091
constexpr double kLids_deg = 70, kLips_deg = 60, kBeyondInner_m = 0.9e-3, kBeyondOuter_m = 1.4e-3;
constexpr std::array<Corner, 6> kCorners{{{"en_l", -1, kLids_deg, kBeyondInner_m},
                                          {"en_r", 1, kLids_deg, kBeyondInner_m},
                                          {"ex_l", 1, kLids_deg, kBeyondOuter_m},
                                          {"ex_r", -1, kLids_deg, kBeyondOuter_m},
                                          {"ch_l", 1, kLips_deg, 0},
                                          {"ch_r", -1, kLips_deg, 0}}};

/// What a ray from the front meets.
struct Sight {
    bool skin = false;
    double down_deg = 0;  // how far the skin faces down
    Vec3 at = Vec3::Zero();
};

Sight sight(const ShownHead& head, double x, double y, double z, double outside) {
    // A little beside the midline, on which many meshes have an edge
    const auto hit = head.tree.cast(Vec3(x + kBeside_m, y + kBeside_m, z), -Vec3::UnitZ());
    if (!hit || head.part[static_cast<std::size_t>(hit->triangle)] != ShownPart::kSkin) return {};
    const auto corner = [&](int k) -> Vec3 {
        return head.positions.row(head.triangles(hit->triangle, k)).transpose();
    };
    const Vec3 normal = outside * (corner(1) - corner(0)).cross(corner(2) - corner(0));
    if (!(normal.z() > 0)) return {};  // the inside of the head, through an open lid
    return {true, std::atan2(-normal.y(), normal.z()) * 180 / std::numbers::pi, hit->point};
}

/// +1 where the normals of the skin point out of the head, else -1.
double outside_of(const ShownHead& head) {
    double sum = 0;
    for (Eigen::Index f = 0; f < head.skin.rows(); ++f) {
        const Vec3 a = head.positions.row(head.skin(f, 0)).transpose(),
                   b = head.positions.row(head.skin(f, 1)).transpose(),
                   c = head.positions.row(head.skin(f, 2)).transpose();
        if (a.z() > 0.05) sum += (b - a).cross(c - a).z();
    }
    return sum < 0 ? -1 : 1;
}

/// The deepest crease of a column of rays.
struct Crease {
    double turn_deg = 0;
    std::optional<Vec3> at;  ///< nothing where no skin is seen
};

/// The column at x of the rows around y, from above.
Crease crease_at(const ShownHead& head, double outside, double x, const Vec3& near) {
    const int rows = static_cast<int>(std::lround(2 * kAbove_m / kStep_m)),
              apart = static_cast<int>(std::lround(kTurnOver_m / kStep_m));
    std::vector<Sight> seen;
    for (int i = 0; i <= rows; ++i)
        seen.push_back(
            sight(head, x, near.y() + kAbove_m - i * kStep_m, near.z() + kBefore_m, outside));
    Crease out;
    double sum = 0;
    Vec3 place = Vec3::Zero();
    for (int i = 0; i + apart <= rows; ++i) {
        bool open = false;
        for (int k = i; k <= i + apart; ++k) open = open || !seen[static_cast<std::size_t>(k)].skin;
        const Sight &above = seen[static_cast<std::size_t>(i)],
                    &below = seen[static_cast<std::size_t>(i + apart)];
        const double turn = open ? kOpen_deg : above.down_deg - below.down_deg;
        if (turn < out.turn_deg) continue;
        if (turn > out.turn_deg) {
            sum = 0;
            place.setZero();
        }
        out.turn_deg = turn;
        // The deepest skin of the window; teeth that have no part of their own lie behind it.
        const Sight* deepest = nullptr;
        for (int k = i; k <= i + apart; ++k) {
            const Sight& here = seen[static_cast<std::size_t>(k)];
            if (here.skin && here.at.z() > near.z() - kDeepest_m &&
                (!deepest || here.at.z() < deepest->at.z()))
                deepest = &here;
        }
        if (!deepest) continue;
        sum += 1;
        place += deepest->at;
    }
    if (sum > 0) out.at = place / sum;
    return out;
}

std::optional<Vec3> corner_near(const ShownHead& head, double outside, const Corner& corner,
                                const Vec3& guess) {
    const int columns = static_cast<int>(std::lround((kInside_m + kOutside_m) / kStep_m));
    std::vector<Crease> found;
    int without = 0;
    bool begun = false;
    for (int i = 0; i <= columns; ++i) {
        const double x = guess.x() + corner.outwards * (i * kStep_m - kInside_m);
        found.push_back(crease_at(head, outside, x, guess));
        if (found.back().turn_deg >= corner.least_deg) {
            begun = true;
            without = 0;
        } else if (begun && ++without == kEndedColumns) {
            const int last = i - kEndedColumns,
                      back = static_cast<int>(std::lround(corner.beyond_m / kStep_m));
            if (last < back) return std::nullopt;
            return found[static_cast<std::size_t>(last - back)].at;
        }
    }
    return std::nullopt;
}

constexpr double kAlong_m = 0.25e-3;  // between points of the profile
constexpr double kAround_m = 5.5e-3;  // of a guess in which an extremal point is looked for
// The same of a ridge. One that is as far from the guess has to turn by so much more: the borders of lips turn by 20 to 80 degrees, and where
// lips are thin, the comparison is off by up to 6.6 mm.
constexpr double kAroundRidge_m = 8e-3, kFar_m = 6e-3, kTurnOfFar_deg = 25;

/// The profile around a point of the midline, from above, as seen from the front.
std::vector<Vec3> profile_near(const ShownHead& head, double outside, const Vec3& near,
                               double around) {
    const double reach = around + 2 * kTurnOver_m;
    std::vector<Vec3> seen;
    for (double y = reach; y >= -reach; y -= kStep_m) {
        const Sight here = sight(head, near.x(), near.y() + y, near.z() + kBefore_m, outside);
        if (here.skin) seen.push_back(here.at);
    }
    std::vector<Vec3> out;
    double walked = 0, next = 0;
    for (std::size_t i = 1; i < seen.size(); ++i) {
        const double length = (seen[i] - seen[i - 1]).norm();
        for (; next < walked + length; next += kAlong_m)
            out.push_back(seen[i - 1] + (next - walked) / length * (seen[i] - seen[i - 1]));
        walked += length;
    }
    return out;
}

/// The ridge of the profile near a guess: where it turns most.
std::optional<Vec3> ridge_near(const ShownHead& head, double outside, const Vec3& guess) {
    const std::vector<Vec3> profile = profile_near(head, outside, guess, kAroundRidge_m);
    const std::size_t apart = static_cast<std::size_t>(std::lround(kTurnOver_m / kAlong_m));
    std::optional<Vec3> out;
    double most = 0;
    for (std::size_t i = apart; i + apart < profile.size(); ++i) {
        const double away = (profile[i] - guess).norm();
        if (away > kAroundRidge_m) continue;
        const Vec3 before = profile[i] - profile[i - apart],
                   after = profile[i + apart] - profile[i];
        // Outwards where the skin turns back: from above, y falls and z first grows.
        const double turn =
            std::atan2(before.y() * after.z() - before.z() * after.y(), before.dot(after)) * 180 /
            std::numbers::pi;
        const double now = turn - kTurnOfFar_deg * std::pow(away / kFar_m, 2);
        if (now <= most) continue;
        most = now;
        out = profile[i];
    }
    return out;
}

/// The point of the profile near a guess that lies most forward (sign 1) or farthest back (-1); nothing where the profile goes on
/// rising to the edge of what is looked at.
std::optional<Vec3> extremal_near(const ShownHead& head, double outside, const Vec3& guess,
                                  double sign) {
    std::optional<Vec3> out;
    for (const Vec3& p : profile_near(head, outside, guess, kAround_m))
        if ((p - guess).norm() < kAround_m && (!out || sign * (p.z() - out->z()) > 0)) out = p;
    if (out && (*out - guess).norm() > kAround_m - 2 * kAlong_m) return std::nullopt;
    return out;
}

}  // namespace

std::map<std::string, Vec3> found_in_front(const ShownHead& head,
                                           const std::map<std::string, Vec3>& at) {
    std::map<std::string, Vec3> out;
    const double outside = outside_of(head);
    for (const Corner& corner : kCorners) {
        const auto guess = at.find(corner.id);
        if (guess == at.end()) continue;
        if (const auto found = corner_near(head, outside, corner, guess->second))
            out[corner.id] = head.skin_tree.closest(*found)->point;
    }
    for (const char* id : {"ls", "li"}) {
        const auto guess = at.find(id);
        if (guess == at.end()) continue;
        if (const auto found = ridge_near(head, outside, guess->second))
            out[id] = head.skin_tree.closest(*found)->point;
    }
    // Where these lie depends on the tilt of the head, too: half of the way
    for (const auto& [id, sign] : {std::pair{"n", -1.0}, std::pair{"prn", 1.0}}) {
        const auto guess = at.find(id);
        if (guess == at.end()) continue;
        if (const auto found = extremal_near(head, outside, guess->second, sign))
            out[id] = head.skin_tree.closest(0.5 * (*found + guess->second))->point;
    }
    if (const auto guess = at.find("sto"); guess != at.end()) {
        const Crease found = crease_at(head, outside, guess->second.x(), guess->second);
        if (found.turn_deg >= kLips_deg && found.at)
            out["sto"] = head.skin_tree.closest(*found.at)->point;
    }
    return out;
}

}  // namespace risorius::landmarks
