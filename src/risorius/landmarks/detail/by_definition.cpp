// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/by_definition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "risorius/landmarks/detail/front_rays.h"
#include "risorius/landmarks/detail/lip_line.h"

namespace risorius::landmarks {

namespace {

constexpr double kStep_m = kRayStep_m;
constexpr double kAbove_m = 4e-3;    // rows above and below a corner
constexpr double kInside_m = 6e-3;   // how far from a corner the crease is surely there
constexpr double kOutside_m = 7e-3;  // how far out a corner is looked for
constexpr int kEndedColumns = 5;     // so many without a crease end it

struct Corner {
    const char* id;
    double outwards;  // along x: of the subject's left, +1
    double beyond_m;  // how far the crease between the lids goes on behind the corner
};
// Measured on ICT-FaceKit, MakeHuman and the adult: docs/decisions/0091
constexpr double kLids_deg = 70;  // a smaller turn is no crease between lids
constexpr double kBeyondInner_m = 0.9e-3, kBeyondOuter_m = 1.4e-3;
constexpr std::array<Corner, 4> kCorners{{{"en_l", -1, kBeyondInner_m},
                                          {"en_r", 1, kBeyondInner_m},
                                          {"ex_l", 1, kBeyondOuter_m},
                                          {"ex_r", -1, kBeyondOuter_m}}};

std::optional<Vec3> corner_near(const FrontRays& rays, const Corner& corner, const Vec3& guess) {
    const int columns = static_cast<int>(std::lround((kInside_m + kOutside_m) / kStep_m));
    std::vector<Crease> found;
    int without = 0;
    bool begun = false;
    for (int i = 0; i <= columns; ++i) {
        const double x = guess.x() + corner.outwards * (i * kStep_m - kInside_m);
        found.push_back(rays.crease({x, guess.y(), kAbove_m - kTurnOver_m / 2, 0, guess.z()}));
        if (found.back().turn_deg >= kLids_deg) {
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

constexpr double kLidAside_m =
    9e-3;                            // of a guess: columns in which the edge of a lid is looked for
constexpr double kLidOver_m = 5e-3;  // rows above and below it
constexpr double kLidFlat_m = 0.2e-3;  // columns whose edge is as near to the highest are its top

/// The last skin of a lid before the eye: of the upper lid (sign 1) from above, of the lower (-1) from below.
std::optional<Vec3> lid_edge_at(const FrontRays& rays, double x, const Vec3& near, double sign) {
    std::optional<Vec3> last;
    for (double y = kLidOver_m; y >= -kLidOver_m; y -= kStep_m) {
        const Sight here = rays.sight(x, near.y() + sign * y, near.z());
        if (here.skin)
            last = here.at;
        else
            return last;
    }
    return std::nullopt;  // no eye: closed lids, or an eye that is drawn as skin
}

/// The highest point of the edge of an upper lid (sign 1), or the lowest of a lower one (-1), near a guess.
std::optional<Vec3> lid_top_near(const FrontRays& rays, const Vec3& guess, double sign) {
    const int aside = static_cast<int>(std::lround(kLidAside_m / kStep_m));
    std::vector<std::optional<Vec3>> edge;
    int top = -1;
    for (int i = -aside; i <= aside; ++i) {
        edge.push_back(lid_edge_at(rays, guess.x() + i * kStep_m, guess, sign));
        const int last = static_cast<int>(edge.size()) - 1;
        if (edge.back() &&
            (top < 0 || sign * (edge.back()->y() - edge[static_cast<std::size_t>(top)]->y()) > 0))
            top = last;
    }
    if (top < 0) return std::nullopt;
    const double highest = edge[static_cast<std::size_t>(top)]->y();
    int first = top, last = top;
    const auto is_top = [&](int i) {
        if (i < 0 || i >= static_cast<int>(edge.size())) return false;
        const auto& here = edge[static_cast<std::size_t>(i)];
        return here && sign * (highest - here->y()) < kLidFlat_m;
    };
    while (is_top(first - 1)) --first;
    while (is_top(last + 1)) ++last;
    if (first == 0 || last + 1 == static_cast<int>(edge.size())) return std::nullopt;
    return edge[static_cast<std::size_t>((first + last) / 2)];
}

constexpr double kAlong_m = 0.25e-3;  // between points of the profile
constexpr double kAround_m = 5.5e-3;  // of a guess in which an extremal point is looked for
// The same of a ridge. One that is as far from the guess has to turn by so much more: the borders of lips turn by 20 to 80 degrees, and where
// lips are thin, the comparison is off by up to 6.6 mm.
constexpr double kAroundRidge_m = 8e-3, kFar_m = 6e-3, kTurnOfFar_deg = 25;
constexpr double kLeastRidge_deg = 10;
constexpr double kRoll_m = 4.2e-3;  // the roll of a lip is nearer to where the lips meet

/// The profile around a point of the midline, from above, as seen from the front.
std::vector<Vec3> profile_near(const FrontRays& rays, const Vec3& near, double around) {
    const double reach = around + 2 * kTurnOver_m;
    std::vector<Vec3> seen;
    for (double y = reach; y >= -reach; y -= kStep_m) {
        const Sight here = rays.sight(near.x(), near.y() + y, near.z());
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

/// The ridge of the profile near a guess: where it turns most. `lips`: where they meet; the roll of a lip is a ridge, too.
std::optional<Vec3> ridge_near(const FrontRays& rays, const Vec3& guess,
                               const std::optional<Vec3>& lips) {
    const std::vector<Vec3> profile = profile_near(rays, guess, kAroundRidge_m);
    const std::size_t apart = static_cast<std::size_t>(std::lround(kTurnOver_m / kAlong_m));
    std::vector<double> turns(profile.size(), 0);
    for (std::size_t i = apart; i + apart < profile.size(); ++i) {
        const Vec3 before = profile[i] - profile[i - apart],
                   after = profile[i + apart] - profile[i];
        // Outwards where the skin turns back: from above, y falls and z first grows.
        turns[i] = std::atan2(before.y() * after.z() - before.z() * after.y(), before.dot(after)) *
                   180 / std::numbers::pi;
    }
    std::optional<Vec3> out;
    double most = 0;
    bool on_roll = true;
    for (std::size_t i = apart; i + apart < profile.size(); ++i) {
        const double away = (profile[i] - guess).norm();
        const auto near = turns.begin() + static_cast<std::ptrdiff_t>(i);
        const auto around = static_cast<std::ptrdiff_t>(apart / 2);
        if (away > kAroundRidge_m || turns[i] < kLeastRidge_deg ||
            *std::max_element(near - around, near + around + 1) > turns[i])
            continue;
        const bool roll = lips && (profile[i] - *lips).norm() < kRoll_m;
        const double now = turns[i] - kTurnOfFar_deg * std::pow(away / kFar_m, 2);
        if ((roll && !on_roll) || (now <= most && roll == on_roll)) continue;
        if (!roll && now <= 0) continue;
        most = now;
        on_roll = roll;
        out = profile[i];
    }
    return out;
}

/// The point of the profile near a guess that lies most forward (sign 1) or farthest back (-1); nothing where the profile goes on
/// rising to the edge of what is looked at.
std::optional<Vec3> extremal_near(const FrontRays& rays, const Vec3& guess, double sign) {
    std::optional<Vec3> out;
    for (const Vec3& p : profile_near(rays, guess, kAround_m))
        if ((p - guess).norm() < kAround_m && (!out || sign * (p.z() - out->z()) > 0)) out = p;
    if (out && (*out - guess).norm() > kAround_m - 2 * kAlong_m) return std::nullopt;
    return out;
}

constexpr double kUnlike_m = 4e-3;
constexpr double kMissed_m = 4e-3;  // a mouth that the comparison puts as far off is missed

using Places = std::map<std::string, Vec3>;

void find_eyes(const FrontRays& rays, const ShownHead& head, const Places& at, Places& out) {
    for (const Corner& corner : kCorners) {
        const auto guess = at.find(corner.id);
        if (guess == at.end()) continue;
        if (const auto found = corner_near(rays, corner, guess->second))
            out[corner.id] = head.skin_tree.closest(*found)->point;
    }
    // Along a flat edge, and beneath the fold of an upper lid, the comparison is as good: half of the way
    for (const auto& [id, sign] : {std::pair{"ps_l", 1.0}, std::pair{"ps_r", 1.0},
                                   std::pair{"pi_l", -1.0}, std::pair{"pi_r", -1.0}}) {
        const auto guess = at.find(id);
        if (guess == at.end()) continue;
        if (const auto found = lid_top_near(rays, guess->second, sign))
            out[id] = head.skin_tree.closest(0.5 * (*found + guess->second))->point;
    }
}

void find_mouth(const FrontRays& rays, const ShownHead& head, const Places& at, Places& out) {
    // Where the comparison misses the mouth, it misses the borders of the lips alike
    Vec3 shift = Vec3::Zero();
    std::optional<Vec3> middle;
    if (const auto guess = at.find("sto"); guess != at.end())
        if (const auto lips = find_lip_line(rays, guess->second)) {
            middle = lips->middle;
            out["sto"] = head.skin_tree.closest(lips->middle)->point;
            shift = lips->middle - guess->second;
            if (lips->left) out["ch_l"] = head.skin_tree.closest(*lips->left)->point;
            if (lips->right) out["ch_r"] = head.skin_tree.closest(*lips->right)->point;
        }
    for (const char* id : {"ls", "li"}) {
        const auto guess = at.find(id);
        if (guess == at.end()) continue;
        if (const auto found = ridge_near(rays, guess->second + shift, middle))
            out[id] = head.skin_tree.closest(*found)->point;
    }
}

/// Both eyes are alike. Where they are not, the corner that is farthest from the comparison is taken out.
void drop_unlike(const Places& at, Places& out) {
    std::string farthest;
    for (const std::string id : {"en_l", "ex_l", "en_r", "ex_r"}) {
        if (!out.count(id)) return;
        if (farthest.empty() ||
            (out.at(id) - at.at(id)).norm() > (out.at(farthest) - at.at(farthest)).norm())
            farthest = id;
    }
    const Vec3 left = out.at("ex_l") - out.at("en_l"), right = out.at("ex_r") - out.at("en_r");
    if ((left - Vec3(-right.x(), right.y(), right.z())).norm() > kUnlike_m) out.erase(farthest);
}

/// What only one side of the face shows is taken over to the other: as far from the comparison, mirrored.
void mirror_missing(const FrontRays& rays, const ShownHead& head, const Places& at, Places& out) {
    for (const std::string name : {"en", "ex", "ch"})
        for (const auto& [from, to] :
             {std::pair{name + "_l", name + "_r"}, std::pair{name + "_r", name + "_l"}}) {
            if (!out.count(from) || out.count(to) || !at.count(to)) continue;
            const Vec3 way = out.at(from) - at.at(from),
                       guess = at.at(to) + Vec3(-way.x(), way.y(), way.z());
            std::optional<Vec3> found;
            for (const Corner& corner : kCorners)
                if (corner.id == to) found = corner_near(rays, corner, guess);
            out[to] = head.skin_tree.closest(found.value_or(guess))->point;
        }
}

}  // namespace

std::map<std::string, Vec3> found_in_front(const ShownHead& head,
                                           const std::map<std::string, Vec3>& at) {
    Places out;
    const FrontRays rays(head);
    find_eyes(rays, head, at, out);
    find_mouth(rays, head, at, out);
    drop_unlike(at, out);
    mirror_missing(rays, head, at, out);
    // Where these lie depends on the tilt of the head, too: half of the way
    for (const auto& [id, sign] : {std::pair{"n", -1.0}, std::pair{"prn", 1.0}}) {
        const auto guess = at.find(id);
        if (guess == at.end()) continue;
        if (const auto found = extremal_near(rays, guess->second, sign))
            out[id] = head.skin_tree.closest(0.5 * (*found + guess->second))->point;
    }
    return out;
}

std::map<std::string, Vec3> missed_lips(const ShownHead& head,
                                        const std::map<std::string, Vec3>& at) {
    const auto guess = at.find("sto");
    if (guess == at.end()) return {};
    const auto lips = find_lip_line(FrontRays(head), guess->second);
    if (!lips || !lips->left || !lips->right) return {};
    std::map<std::string, Vec3> out{
        {"sto", lips->middle}, {"ch_l", *lips->left}, {"ch_r", *lips->right}};
    for (const auto& [id, p] : out) {
        const auto compared = at.find(id);
        if (compared != at.end() && (p - compared->second).norm() > kMissed_m) return out;
    }
    return {};
}

}  // namespace risorius::landmarks
