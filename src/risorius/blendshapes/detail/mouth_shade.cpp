// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/mouth_shade.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "risorius/core/rotations.h"
#include "risorius/core/srgb.h"
#include "risorius/geom/closest_point.h"

namespace risorius::blendshapes {

namespace {

constexpr int kRays = 40;
constexpr double kFarthest_m = 0.25;  ///< what lies beyond shades nothing
constexpr double kOffset_m = 3e-4;    ///< from the surface to where a ray begins
/// Linear light where nothing is seen, from wall to wall of the mouth
constexpr double kBounced = 0.03;
constexpr double kStill_m = 1e-3;  ///< a vertex that moves less hardly moves
constexpr double kBared = 1;       ///< weight of each shape that bares the teeth
constexpr double kNearEye = 2.2;   ///< radii of the eye: the socket, which is no part of the mouth

bool is_inside(const io::MorphPart& part) {
    return part.name == "Mouth" || part.name == "Teeth" || part.name == "Gums" ||
           part.name == "Tongue";
}

/// The vertices while the jaw is open.
Points open_pose(const rig::Head& head, const io::MorphModel& model) {
    const io::MorphTarget* widest = nullptr;
    double lowest = 0;
    for (const io::MorphTarget& target : model.targets) {
        double sum = 0;
        for (std::size_t i = 0; i < target.vertex.size(); ++i)
            if (head.carrier[static_cast<std::size_t>(target.vertex[i])] == rig::Carrier::kMandible)
                sum += target.delta(static_cast<long>(i), 1);
        if (sum < lowest) {
            lowest = sum;
            widest = &target;
        }
    }
    Points pose = model.vertices;
    if (widest)
        for (std::size_t i = 0; i < widest->vertex.size(); ++i)
            pose.row(widest->vertex[i]) += widest->delta.row(static_cast<long>(i));
    return pose;
}

/// Whether a target moves the lower teeth.
bool moves_jaw(const rig::Head& head, const io::MorphTarget& target) {
    for (std::size_t i = 0; i < target.vertex.size(); ++i)
        if (head.carrier[static_cast<std::size_t>(target.vertex[i])] == rig::Carrier::kMandible &&
            target.delta.row(static_cast<long>(i)).norm() > kStill_m)
            return true;
    return false;
}

/// How a target moves one vertex.
Vec3 delta_at(const io::MorphTarget& target, int vertex) {
    const auto found = std::lower_bound(target.vertex.begin(), target.vertex.end(), vertex);
    if (found == target.vertex.end() || *found != vertex) return Vec3::Zero();
    return target.delta.row(found - target.vertex.begin());
}

/// The vertices while the lips bare the teeth, with the jaw shut: by the shapes that raise the upper lip most, lower the lower lip
/// most, and draw the corners of the mouth up and aside most, on both sides. None: there are no such shapes.
std::optional<Points> bared_pose(const rig::Head& head, const io::MorphModel& model) {
    const auto skin = std::find_if(model.parts.begin(), model.parts.end(),
                                   [](const io::MorphPart& part) { return part.name == "Skin"; });
    if (skin == model.parts.end()) return {};
    std::set<const io::MorphTarget*> chosen;
    for (const auto& [landmark, up, aside] :
         {std::tuple{"ulc_l", 1, 0}, std::tuple{"ulc_r", 1, 0}, std::tuple{"llc_l", -1, 0},
          std::tuple{"llc_r", -1, 0}, std::tuple{"ch_l", 1, 1}, std::tuple{"ch_r", 1, 1}}) {
        const Vec3 place = head.landmark(landmark);
        const Vec3 way = Vec3(place.x() < 0 ? -aside : aside, up, 0).normalized();
        int nearest = skin->triangles(0, 0);
        for (const int v : skin->triangles.reshaped())
            if ((model.vertices.row(v).transpose() - place).squaredNorm() <
                (model.vertices.row(nearest).transpose() - place).squaredNorm())
                nearest = v;
        const io::MorphTarget* best = nullptr;
        double most_m = kStill_m;
        for (const io::MorphTarget& target : model.targets)
            if (const double along_m = delta_at(target, nearest).dot(way); along_m > most_m)
                if (!moves_jaw(head, target)) {
                    most_m = along_m;
                    best = &target;
                }
        if (best) chosen.insert(best);
    }
    if (chosen.empty()) return {};
    Points pose = model.vertices;
    for (const io::MorphTarget& target :
         model.targets)  // in their order, so that sums are the same
        if (chosen.count(&target) > 0)
            for (std::size_t i = 0; i < target.vertex.size(); ++i)
                pose.row(target.vertex[i]) += kBared * target.delta.row(static_cast<long>(i));
    return pose;
}

/// Directions about +z, as dense as the cosine of their angle to it.
std::vector<Vec3> directions() {
    std::vector<Vec3> out;
    const double golden = M_PI * (3 - std::sqrt(5.0));
    for (int i = 0; i < kRays; ++i) {
        const double share = (i + 0.5) / kRays, radius = std::sqrt(share);
        out.emplace_back(radius * std::cos(golden * i), radius * std::sin(golden * i),
                         std::sqrt(1 - share));
    }
    return out;
}

/// The share of rays about a normal that leave the head.
double seen(const geom::SurfaceTree& tree, const Vec3& at, const Vec3& normal,
            const std::vector<Vec3>& about_z) {
    const Eigen::Quaterniond turn = turn_between(Vec3::UnitZ(), normal);
    int free = 0;
    for (const Vec3& direction : about_z)
        if (!tree.cast(at + kOffset_m * normal, turn * direction, kFarthest_m)) ++free;
    return static_cast<double>(free) / kRays;
}

/// A pose of the head as what stands in the way of light, with the normals of what is shaded.
struct ShadedPose {
    Points vertices, normals;
    geom::SurfaceTree tree;
};

ShadedPose shaded_pose(const io::MorphModel& model, const Points& pose) {
    std::vector<int> corners;
    Points normals = Points::Zero(pose.rows(), 3);
    for (const io::MorphPart& part : model.parts) {
        if (part.name != "Skin" && !is_inside(part)) continue;
        for (long t = 0; t < part.triangles.rows(); ++t) {
            const auto p = [&](int k) -> Vec3 { return pose.row(part.triangles(t, k)); };
            const Vec3 normal = (p(1) - p(0)).cross(p(2) - p(0));
            for (int k = 0; k < 3; ++k) {
                corners.push_back(part.triangles(t, k));
                normals.row(part.triangles(t, k)) += normal.transpose();
            }
        }
    }
    return {pose, normals,
            geom::SurfaceTree(pose, Eigen::Map<Triangles>(
                                        corners.data(), static_cast<long>(corners.size() / 3), 3))};
}

}  // namespace

void shade_mouth(const rig::Head& head, io::MorphModel& model) {
    if (std::none_of(model.parts.begin(), model.parts.end(), is_inside)) return;
    const ShadedPose open = shaded_pose(model, open_pose(head, model));
    std::optional<ShadedPose> bared;
    if (const std::optional<Points> pose = bared_pose(head, model))
        bared.emplace(shaded_pose(model, *pose));
    const long count = model.vertices.rows();
    enum Kind : char { kNone, kWall, kTeeth, kTongue };
    std::vector<Kind> kinds(static_cast<std::size_t>(count), kNone);
    for (const io::MorphPart& part : model.parts)
        if (is_inside(part))
            for (const int v : part.triangles.reshaped())
                kinds[static_cast<std::size_t>(v)] = part.name == "Mouth"    ? kWall
                                                     : part.name == "Tongue" ? kTongue
                                                                             : kTeeth;
    const std::vector<Vec3> about_z = directions();
    const auto share_in = [&](const ShadedPose& pose, long v, double side) {
        const Vec3 normal = side * pose.normals.row(v).normalized();
        return normal.allFinite() ? seen(pose.tree, pose.vertices.row(v), normal, about_z) : 0.0;
    };
    Points tint = Points::Ones(count, 3);
    for (long v = 0; v < count; ++v) {
        const Kind kind = kinds[static_cast<std::size_t>(v)];
        const Vec3 at = open.vertices.row(v);
        const auto near = [&](const rig::EyeGeometry& eye) {
            return eye.present && (at - eye.centre).norm() < kNearEye * eye.radius_m;
        };
        if (kind == kNone || !open.normals.row(v).normalized().allFinite() ||
            std::any_of(head.eyes.begin(), head.eyes.end(), near))
            continue;
        double share = share_in(open, v, 1);
        // The wall is seen from the side that faces the mouth, whichever that is. Teeth are seen in a smile too.
        if (kind == kWall) share = std::max(share, share_in(open, v, -1));
        if (kind == kTeeth && bared) share = std::max(share, share_in(*bared, v, 1));
        tint.row(v).setConstant(srgb_of_linear(kBounced + (1 - kBounced) * share));
    }
    for (io::MorphPart& part : model.parts)
        if (is_inside(part)) part.tint = tint;
}

}  // namespace risorius::blendshapes
