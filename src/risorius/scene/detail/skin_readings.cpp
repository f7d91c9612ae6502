// SPDX-License-Identifier: MIT
#include "risorius/scene/detail/skin_readings.h"

#include <algorithm>
#include <cmath>

#include "risorius/face/anatomy/shell.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/surfaces.h"
#include "risorius/geom/polyline.h"
#include "risorius/rig/head.h"
#include "risorius/scene/expression_score.h"

namespace risorius::scene {

namespace {

constexpr int kProfilePoints = 33;
constexpr double kTouching_mm = 0.5;
// Millimetres on the average head
constexpr double kFarthestSkin_mm = 20;
constexpr double kMouthBank_mm = 9, kCheekBank_mm = 13;  // from the fold between nose and cheek
constexpr double kLipHeight_mm = 9;

Vec3 on_line(const Vec3& from, const Vec3& to, double part) { return from + part * (to - from); }

// Height of the line between the lips at the x of a point.
double seam_height(const std::vector<Vec3>& lips, double x) {
    for (std::size_t i = 1; i < lips.size(); ++i) {
        const double low = std::min(lips[i - 1].x(), lips[i].x()),
                     high = std::max(lips[i - 1].x(), lips[i].x());
        if (x < low || x > high || high == low) continue;
        return on_line(lips[i - 1], lips[i],
                       (x - lips[i - 1].x()) / (lips[i].x() - lips[i - 1].x()))
            .y();
    }
    return std::abs(x - lips.front().x()) < std::abs(x - lips.back().x()) ? lips.front().y()
                                                                          : lips.back().y();
}

}  // namespace

double depth_below_hull(const std::vector<Vec3>& profile, const Vec3& outward) {
    const Vec3 chord = profile.back() - profile.front();
    const Vec3 along = chord.normalized();
    const Vec3 up = (outward - outward.dot(along) * along).normalized();
    std::vector<std::pair<double, double>> points;
    for (const Vec3& p : profile)
        points.emplace_back((p - profile.front()).dot(along), (p - profile.front()).dot(up));
    std::sort(points.begin(), points.end());
    // The upper hull: no point lies to the left of a side
    std::vector<std::pair<double, double>> hull;
    const auto turns_left = [&](const std::pair<double, double>& p) {
        const auto& a = hull[hull.size() - 2];
        const auto& b = hull.back();
        return (b.first - a.first) * (p.second - a.second) -
                   (b.second - a.second) * (p.first - a.first) >=
               0;
    };
    for (const auto& p : points) {
        while (hull.size() >= 2 && turns_left(p)) hull.pop_back();
        hull.push_back(p);
    }
    double depth = 0;
    std::size_t side = 1;
    for (const auto& [s, height] : points) {
        while (side + 1 < hull.size() && hull[side].first < s) ++side;
        const auto &a = hull[side - 1], &b = hull[side];
        if (b.first <= a.first) continue;
        const double part = (s - a.first) / (b.first - a.first);
        depth = std::max(depth, a.second + part * (b.second - a.second) - height);
    }
    return depth;
}

SkinReader::SkinReader(face::Face& face, const rig::RigDescription& rig)
    : face_(face), skin_(face.surfaces().simulated_skin()), rest_(face.head().vertices, skin_) {
    place_furrows();
    const auto only = [&](Furrow furrow, const char* pattern) {
        std::array<bool, 3>& slots = places_[static_cast<std::size_t>(furrow)].slots;
        slots = {};
        for (const rig::WrinklePattern& one : rig.atlas.wrinkles)
            if (one.name == pattern) slots[static_cast<std::size_t>(one.slot)] = true;
    };
    only(Furrow::kGlabellar, "frown");
    only(Furrow::kForehead, "forehead");
    place_lips();
}

SkinReader::Profile SkinReader::profile(const Vec3& from, const Vec3& to) const {
    const rig::Head& head = face_.head();
    Profile out{{}, Vec3::Zero()};
    for (int i = 0; i < kProfilePoints; ++i) {
        const Vec3 p = on_line(from, to, static_cast<double>(i) / (kProfilePoints - 1));
        const auto found = rest_.closest(p, head.mm(kFarthestSkin_mm));
        if (!found) continue;
        out.points.push_back({found->triangle, found->barycentric, Vec3::Zero()});
        const auto corner = [&](int k) -> Vec3 {
            return head.vertices.row(skin_(found->triangle, k)).transpose();
        };
        out.outward += (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    }
    return out;
}

void SkinReader::place_furrows() {
    const rig::Head& head = face_.head();
    const auto at = [&](const char* id) { return head.landmark(id); };
    const std::vector<Vec3> fold{at("nl1_l"), at("nl2_l"), at("nl3_l")};
    const Vec3 down = (fold[2] - fold[0]).normalized();
    const Vec3 aside = (Vec3::UnitX() - Vec3::UnitX().dot(down) * down).normalized();
    Place& nasolabial = places_[0];
    for (const Vec3& middle :
         {on_line(fold[0], fold[1], 0.5), fold[1], on_line(fold[1], fold[2], 0.5)})
        nasolabial.profiles.push_back(profile(middle - head.mm(kMouthBank_mm) * aside,
                                              middle + head.mm(kCheekBank_mm) * aside));
    places_[1].profiles.push_back(profile(at("bm_r"), at("bm_l")));
    places_[2].profiles.push_back(profile(at("bc_l"), at("fml_l")));

    const Eigen::VectorXd area = vertex_areas(skin_, head.vertices);
    const double frown_half = std::abs(at("bm_l").x()), frown_top = at("g").y() + head.mm(16);
    for (int v = 0; v < static_cast<int>(area.size()); ++v) {
        if (!(area[v] > 0)) continue;
        const Vec3 p = head.vertices.row(v).transpose();
        if (geom::distance_to_polyline(p, fold) < head.mm(6)) nasolabial.wrinkled.push_back(v);
        const bool frown = std::abs(p.x()) < frown_half && p.y() < frown_top;
        if (frown && p.y() > at("n").y() + head.mm(4) && p.z() > at("bl_l").z())
            places_[1].wrinkled.push_back(v);
        if (!frown && p.y() > at("bc_l").y() + head.mm(6) && p.y() < at("tr").y() &&
            std::abs(p.x()) < at("ft_l").x())
            places_[2].wrinkled.push_back(v);
    }
}

void SkinReader::place_lips() {
    const rig::Head& head = face_.head();
    const std::vector<Vec3> lips = face::lip_line(head);
    const Eigen::VectorXd area = vertex_areas(skin_, head.vertices);
    std::vector<char> near(static_cast<std::size_t>(area.size())), upper(near.size());
    for (int v = 0; v < static_cast<int>(area.size()); ++v) {
        const Vec3 p = head.vertices.row(v).transpose();
        if (!(area[v] > 0) || geom::distance_to_polyline(p, lips) > head.mm(kLipHeight_mm))
            continue;
        const auto i = static_cast<std::size_t>(v);
        near[i] = 1;
        upper[i] = p.y() > seam_height(lips, p.x()) ? 1 : 0;
        if (upper[i]) upper_lip_.push_back(v);
    }
    std::vector<int> lower;
    for (int t = 0; t < skin_.rows(); ++t) {
        int count = 0;
        for (int k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(skin_(t, k));
            count += near[v] && !upper[v] ? 1 : 0;
        }
        if (count == 3) lower.push_back(t);
    }
    lower_lip_.resize(static_cast<long>(lower.size()), 3);
    for (std::size_t i = 0; i < lower.size(); ++i)
        lower_lip_.row(static_cast<long>(i)) = skin_.row(lower[i]);
}

double SkinReader::furrow_mm(Furrow furrow, const face::FacePose& pose) const {
    const Place& place = places_[static_cast<std::size_t>(furrow)];
    double deepest = 0, wrinkle = 0;
    for (const Profile& one : place.profiles) {
        if (one.points.size() < 3) continue;
        std::vector<Vec3> now;
        for (const geom::SurfaceBinding& point : one.points)
            now.push_back(geom::bound_point(point, pose.vertices, skin_));
        deepest = std::max(deepest, depth_below_hull(now, one.outward));
    }
    if (pose.fold_depth.rows() > 0)
        for (const int v : place.wrinkled)
            for (int slot = 0; slot < 3; ++slot)
                if (place.slots[static_cast<std::size_t>(slot)])
                    wrinkle = std::max(wrinkle, pose.fold_depth(v, slot));
    return 1e3 * (deepest + wrinkle);
}

double SkinReader::lip_contact_mm2(const face::FacePose& pose) const {
    if (lower_lip_.rows() == 0) return 0;
    const geom::SurfaceTree lower(pose.vertices, lower_lip_);
    const Eigen::VectorXd area = vertex_areas(skin_, pose.vertices);
    double touching = 0;
    for (const int v : upper_lip_)
        if (lower.closest(pose.vertices.row(v).transpose(), 1e-3 * kTouching_mm))
            touching += area[v];
    return 1e6 * touching;
}

}  // namespace risorius::scene
