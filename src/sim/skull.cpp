#include "sim/skull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "geom/closest_point.h"
#include "geom/surface_net.h"
#include "rig/landmark_warp.h"
#include "sim/skull_shapes.h"
#include "sim/tissue_mesh.h"

namespace risorius::sim {

namespace {

constexpr double kStep_mm = 1.5;     // of the finest grid
constexpr int kCoarse = 4;           // steps of the coarse one
constexpr double kRound_mm = 1.6;    // of the edge between measured and assumed bone
constexpr double kSteepest = 1.6;    // of the fields, about, for what the coarse grid can rule out
constexpr double kFarSkin_mm = 45;   // tissue is nowhere as thick
constexpr double kSpread_mm = 0.02;  // smoothing of the warp

/// From the head to the standard head.
rig::LandmarkWarp to_standard(const rig::Head& head, const rig::RigDescription& rig) {
    std::vector<Vec3> from, to;
    for (const rig::AtlasLandmark& landmark : rig.atlas.landmarks) {
        from.push_back(head.landmark(landmark.id));
        to.push_back(landmark.position);
    }
    // Eyes, which the orbits lie around (skull.json)
    for (const double side : {1.0, -1.0}) {
        const rig::EyeGeometry& eye = head.eyes[side > 0 ? 0 : 1];
        if (!eye.present) continue;
        from.push_back(eye.centre);
        to.emplace_back(side * 31.5e-3, 18.2e-3, 74e-3);
    }
    Points a(static_cast<long>(from.size()), 3), b(a.rows(), 3);
    for (long i = 0; i < a.rows(); ++i) {
        a.row(i) = from[static_cast<std::size_t>(i)].transpose();
        b.row(i) = to[static_cast<std::size_t>(i)].transpose();
    }
    return {a, b, 1e-3 * kSpread_mm};
}

/// How deep under the tissue a place is, m: 0 where the outer side of bone is.
class TissueDepth {
  public:
    TissueDepth(const rig::Head& head, const rig::RigDescription& rig)
        : head_(head), rig_(rig), tree_(head.vertices, head.skin) {
        normal_.assign(static_cast<std::size_t>(head.vertices.rows()), Vec3::Zero());
        for (long f = 0; f < head.skin.rows(); ++f) {
            const Vec3 a = head.vertices.row(head.skin(f, 0)),
                       b = head.vertices.row(head.skin(f, 1)),
                       c = head.vertices.row(head.skin(f, 2));
            for (int k = 0; k < 3; ++k)
                normal_[static_cast<std::size_t>(head.skin(f, k))] +=
                    (b - a).cross(c - a).normalized();
        }
    }

    double operator()(const Vec3& p) const {
        const double far = head_.mm(kFarSkin_mm);
        const auto foot = tree_.closest(p, far);
        if (!foot) return far;
        Vec3 outward = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            outward += foot->barycentric[k] *
                       normal_[static_cast<std::size_t>(head_.skin(foot->triangle, k))];
        const double distance = std::sqrt(foot->squared_distance);
        const double inside = (p - foot->point).dot(outward) > 0 ? -distance : distance;
        return inside - interpolate_thickness(head_, rig_.atlas.thickness, foot->point);
    }

  private:
    const rig::Head& head_;
    const rig::RigDescription& rig_;
    geom::SurfaceTree tree_;
    std::vector<Vec3> normal_;
};

/// Samples a field where the coarse grid does not rule out that it is zero; elsewhere what that has.
BoneSurface surface_of(const std::function<double(const Vec3&)>& field, const Vec3& low,
                       const Vec3& high, double step_m) {
    geom::GridField coarse(low, high, kCoarse * step_m, 0);
    for (int k = 0; k < coarse.size[2]; ++k)
        for (int j = 0; j < coarse.size[1]; ++j)
            for (int i = 0; i < coarse.size[0]; ++i)
                coarse.values[coarse.index(i, j, k)] =
                    static_cast<float>(field(coarse.place(i, j, k)));
    geom::GridField fine(
        low, coarse.place(coarse.size[0] - 1, coarse.size[1] - 1, coarse.size[2] - 1), step_m, 0);
    const double near = kSteepest * 0.5 * std::sqrt(3.0) * kCoarse * step_m;
    for (int k = 0; k < fine.size[2]; ++k)
        for (int j = 0; j < fine.size[1]; ++j)
            for (int i = 0; i < fine.size[0]; ++i) {
                const Vec3 p = fine.place(i, j, k);
                const int ci = (i + kCoarse / 2) / kCoarse, cj = (j + kCoarse / 2) / kCoarse,
                          ck = (k + kCoarse / 2) / kCoarse;
                const double about = coarse.values[coarse.index(std::min(ci, coarse.size[0] - 1),
                                                                std::min(cj, coarse.size[1] - 1),
                                                                std::min(ck, coarse.size[2] - 1))];
                fine.values[fine.index(i, j, k)] =
                    static_cast<float>(std::abs(about) > near ? about : field(p));
            }
    geom::NetSurface net = geom::surface_net(fine);

    // What is seen from a place, by how much farther bone is than the place itself on the way outwards
    BoneSurface surface;
    surface.vertices = std::move(net.vertices);
    surface.triangles = std::move(net.triangles);
    std::vector<Vec3> normal(static_cast<std::size_t>(surface.vertices.rows()), Vec3::Zero());
    for (long f = 0; f < surface.triangles.rows(); ++f) {
        const Vec3 a = surface.vertices.row(surface.triangles(f, 0)),
                   b = surface.vertices.row(surface.triangles(f, 1)),
                   c = surface.vertices.row(surface.triangles(f, 2));
        for (int k = 0; k < 3; ++k)
            normal[static_cast<std::size_t>(surface.triangles(f, k))] += (b - a).cross(c - a);
    }
    for (long v = 0; v < surface.vertices.rows(); ++v) {
        const Vec3 p = surface.vertices.row(v).transpose(),
                   n = normal[static_cast<std::size_t>(v)].normalized();
        double shut = 0, weights = 0, weight = 1;
        for (const double steps : {2.0, 4.0, 8.0, 14.0, 22.0}) {
            const double reach = steps * step_m;
            shut += weight * std::clamp(1 - fine.at(p + reach * n) / reach, 0.0, 1.0);
            weights += weight;
            weight *= 0.85;
        }
        surface.open.push_back(1 - shut / weights);
    }
    return surface;
}

}  // namespace

Skull estimate_skull(const rig::Head& head, const rig::RigDescription& rig) {
    const rig::LandmarkWarp warp = to_standard(head, rig);
    const TissueDepth depth(head, rig);
    const double per_mm = head.mm(1);
    const auto field_of = [&](const std::function<BoneFields(const Vec3&)>& bone, bool nose) {
        return [&depth, &warp, per_mm, bone, nose](const Vec3& p) {
            constexpr double kFar_mm = 12;
            const Vec3 standard = 1e3 * warp(p);
            const BoneFields fields = bone(standard);
            double out = fields.outer;
            if (out < kFar_mm) {  // else the thickness does not matter
                const double under = depth(p) / per_mm;
                out = smooth_cut(out, -under, kRound_mm);
                out = smooth_cut(out, -fields.carved, 2.5);
                if (nose) out = smooth_union(out, nasal_bone_field(standard, under), 2);
            }
            return per_mm * smooth_union(out, fields.inner, 3);
        };
    };
    const auto box = [&](const Vec3& low_mm, const Vec3& high_mm) {
        // Of the standard head, as large on this one, with room for what is longer or wider
        Vec3 low = Vec3::Constant(1e9), high = -low;
        for (const auto& [id, at] : head.landmarks) {
            low = low.cwiseMin(at);
            high = high.cwiseMax(at);
        }
        return std::pair(low.cwiseMax(head.mm(1) * (low_mm - Vec3::Constant(15))),
                         high.cwiseMin(head.mm(1) * (high_mm + Vec3::Constant(15))));
    };
    Skull skull;
    const auto [low, high] = box({-80, -60, -100}, {80, 135, 120});
    skull.cranium = surface_of(field_of(skull_fields, true), low, high, head.mm(kStep_mm));
    const auto [jaw_low, jaw_high] = box({-70, -110, -5}, {70, 10, 100});
    skull.mandible =
        surface_of(field_of(mandible_fields, false), jaw_low, jaw_high, head.mm(kStep_mm));
    return skull;
}

}  // namespace risorius::sim
