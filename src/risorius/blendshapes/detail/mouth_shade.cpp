// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/mouth_shade.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "risorius/core/rotations.h"
#include "risorius/geom/closest_point.h"

namespace risorius::blendshapes {

namespace {

constexpr int kRays = 40;
constexpr double kFarthest_m = 0.25;  ///< what lies beyond shades nothing
constexpr double kOffset_m = 3e-4;    ///< from the surface to where a ray begins
/// Linear light where nothing is seen, from wall to wall of the mouth
constexpr double kBounced = 0.03;
constexpr double kNearEye = 2.2;  ///< radii of the eye: the socket, which is no part of the mouth

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

double srgb_of_linear(double value) {
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace

void shade_mouth(const rig::Head& head, io::MorphModel& model) {
    if (std::none_of(model.parts.begin(), model.parts.end(), is_inside)) return;
    const Points pose = open_pose(head, model);
    // What stands in the way, and the normals of what is shaded
    std::vector<int> corners;
    Points normals = Points::Zero(pose.rows(), 3);
    std::vector<char> wanted(static_cast<std::size_t>(pose.rows()), 0),
        is_wall(static_cast<std::size_t>(pose.rows()), 0);
    for (const io::MorphPart& part : model.parts) {
        if (part.name != "Skin" && !is_inside(part)) continue;
        for (long t = 0; t < part.triangles.rows(); ++t) {
            const auto p = [&](int k) -> Vec3 { return pose.row(part.triangles(t, k)); };
            const Vec3 normal = (p(1) - p(0)).cross(p(2) - p(0));
            for (int k = 0; k < 3; ++k) {
                const int v = part.triangles(t, k);
                corners.push_back(v);
                normals.row(v) += normal.transpose();
                if (!is_inside(part)) continue;
                wanted[static_cast<std::size_t>(v)] = 1;
                is_wall[static_cast<std::size_t>(v)] = part.name == "Mouth";
            }
        }
    }
    const geom::SurfaceTree tree(
        pose, Eigen::Map<Triangles>(corners.data(), static_cast<long>(corners.size() / 3), 3));
    const std::vector<Vec3> about_z = directions();
    Points tint = Points::Ones(pose.rows(), 3);
    for (long v = 0; v < pose.rows(); ++v) {
        const Vec3 at = pose.row(v), normal = normals.row(v).normalized();
        const auto near = [&](const rig::EyeGeometry& eye) {
            return eye.present && (at - eye.centre).norm() < kNearEye * eye.radius_m;
        };
        if (!wanted[static_cast<std::size_t>(v)] || !normal.allFinite() ||
            std::any_of(head.eyes.begin(), head.eyes.end(), near))
            continue;
        double share = seen(tree, at, normal, about_z);
        // The wall is seen from the side that faces the mouth, whichever that is.
        if (is_wall[static_cast<std::size_t>(v)])
            share = std::max(share, seen(tree, at, -normal, about_z));
        tint.row(v).setConstant(srgb_of_linear(kBounced + (1 - kBounced) * share));
    }
    for (io::MorphPart& part : model.parts)
        if (is_inside(part)) part.tint = tint;
}

}  // namespace risorius::blendshapes
