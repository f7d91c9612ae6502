// SPDX-License-Identifier: MIT
#include "risorius/face/view/skull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/view/detail/skull_shapes.h"
#include "risorius/geom/closest_point.h"
#include "risorius/geom/surface_net.h"
#include "risorius/geom/surface_topology.h"
#include "risorius/rig/landmark_warp.h"

namespace risorius::face {

namespace {

constexpr int kCoarse = 4;         // coarse step / fine step of the grids
constexpr double kRound_mm = 1.6;  // rounding of the edge between measured and assumed bone
constexpr double kSteepest =
    1.6;  // approximate maximum slope of the fields; the coarse grid rules out cells with it
constexpr double kFarSkin_mm = 45;   // more than the maximum thickness of the tissue
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

/// Returns the skin that lies over bone. The linings of mouth and nose and the skin on the eyes are left out where they are part of the
/// same piece; hardly any direction leads outside from there.
Triangles outer_skin(const rig::Head& head) {
    constexpr double kOnEye = 1.3, kGolden_rad = 2.399963229728653;
    constexpr int kWays = 16, kEnough = 4;
    const geom::SurfaceTree tree(head.vertices, head.skin);
    const auto is_outside = [&](const Vec3& middle, const Vec3& normal) {
        const Vec3 across = normal.unitOrthogonal(), along = normal.cross(across);
        int free = 0;
        for (int way = 0; way < kWays; ++way) {
            const double sine = std::sqrt((way + 0.5) / kWays), turn = kGolden_rad * way;
            const Vec3 towards = std::sqrt(1 - sine * sine) * normal +
                                 sine * (std::cos(turn) * across + std::sin(turn) * along);
            free += !tree.cast(middle + head.mm(0.2) * normal, towards);
            if (free >= kEnough) return true;
            if (free + kWays - 1 - way < kEnough) return false;
        }
        return false;
    };
    std::vector<long> kept;
    for (long f = 0; f < head.skin.rows(); ++f) {
        const Vec3 a = head.vertices.row(head.skin(f, 0)), b = head.vertices.row(head.skin(f, 1)),
                   c = head.vertices.row(head.skin(f, 2));
        const Vec3 middle = (a + b + c) / 3, normal = (b - a).cross(c - a).normalized();
        const bool on_eye =
            std::any_of(head.eyes.begin(), head.eyes.end(), [&](const rig::EyeGeometry& eye) {
                return eye.present && (middle - eye.centre).norm() < kOnEye * eye.radius_m;
            });
        if (!on_eye && is_outside(middle, normal)) kept.push_back(f);
    }
    Triangles skin(static_cast<long>(kept.size()), 3);
    for (long i = 0; i < skin.rows(); ++i)
        skin.row(i) = head.skin.row(kept[static_cast<std::size_t>(i)]);
    return skin;
}

/// Returns the depth of a point below the outer side of the bone, m.
class TissueDepth {
  public:
    TissueDepth(const rig::Head& head, const rig::RigDescription& rig)
        : head_(head), rig_(rig), skin_(outer_skin(head)), tree_(head.vertices, skin_) {
        border_.assign(static_cast<std::size_t>(head.vertices.rows()), 0);
        const geom::SurfaceEdges edges = geom::surface_edges(skin_);
        for (int e = 0; e < edges.count(); ++e)
            if (edges.triangle_count(e) == 1)
                for (const int v : edges.vertices[static_cast<std::size_t>(e)])
                    border_[static_cast<std::size_t>(v)] = 1;
        normal_.assign(static_cast<std::size_t>(head.vertices.rows()), Vec3::Zero());
        for (long f = 0; f < skin_.rows(); ++f) {
            const Vec3 a = head.vertices.row(skin_(f, 0)), b = head.vertices.row(skin_(f, 1)),
                       c = head.vertices.row(skin_(f, 2));
            for (int k = 0; k < 3; ++k)
                normal_[static_cast<std::size_t>(skin_(f, k))] += (b - a).cross(c - a).normalized();
        }
    }

    double operator()(const Vec3& p) const {
        const double far = head_.mm(kFarSkin_mm);
        const auto foot = tree_.closest(p, far);
        if (!foot) return far;
        Vec3 outward = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            outward +=
                foot->barycentric[k] * normal_[static_cast<std::size_t>(skin_(foot->triangle, k))];
        const double distance = std::sqrt(foot->squared_distance);
        // Behind an opening, such as those of the eyes, the rim of the skin is nearest
        const bool outside = !at_border(*foot) && (p - foot->point).dot(outward) > 0;
        const double inside = outside ? -distance : distance;
        return inside - interpolate_thickness(head_, rig_.atlas.thickness, foot->point);
    }

  private:
    bool at_border(const geom::SurfacePoint& foot) const {
        for (int k = 0; k < 3; ++k)
            if (foot.barycentric[k] > 1e-9 &&
                !border_[static_cast<std::size_t>(skin_(foot.triangle, k))])
                return false;
        return true;
    }

    const rig::Head& head_;
    const rig::RigDescription& rig_;
    Triangles skin_;
    geom::SurfaceTree tree_;
    std::vector<Vec3> normal_;
    std::vector<char> border_;  ///< V
};

/// Smooths the steps of the grid out of a surface and keeps its size (Taubin 1995).
void smooth(geom::NetSurface& net) {
    const geom::SurfaceEdges edges = geom::surface_edges(net.triangles);
    for (const double fraction : {0.5, -0.53, 0.5, -0.53, 0.5, -0.53, 0.5, -0.53, 0.5, -0.53}) {
        Points sum = Points::Zero(net.vertices.rows(), 3);
        std::vector<int> count(static_cast<std::size_t>(net.vertices.rows()), 0);
        for (const auto& [a, b] : edges.vertices) {
            sum.row(a) += net.vertices.row(b);
            sum.row(b) += net.vertices.row(a);
            ++count[static_cast<std::size_t>(a)];
            ++count[static_cast<std::size_t>(b)];
        }
        for (long v = 0; v < net.vertices.rows(); ++v)
            net.vertices.row(v) +=
                fraction * (sum.row(v) / count[static_cast<std::size_t>(v)] - net.vertices.row(v));
    }
}

/// Samples a field where the coarse grid does not rule out a zero; elsewhere takes the value of the coarse grid.
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

    smooth(net);

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

Skull estimate_skull(const rig::Head& head, const rig::RigDescription& rig, double step_mm) {
    const rig::LandmarkWarp warp = to_standard(head, rig);
    const TissueDepth depth(head, rig);
    const double per_mm = head.mm(1);
    const SkullShapes& shapes = standard_skull_shapes();
    const auto field_of = [&](const std::function<BoneFields(const Vec3&)>& bone, bool nose) {
        return [&depth, &warp, &shapes, per_mm, bone, nose](const Vec3& p) {
            constexpr double kFar_mm = 12, kTempleRound_mm = 14;
            const Vec3 standard = 1e3 * warp(p);
            const BoneFields fields = bone(standard);
            double out = fields.outer;
            const bool at_nose = nose && near_nasal_bone(standard);
            if (std::min(out, fields.vault) < kFar_mm ||
                at_nose) {  // otherwise the thickness does not matter
                const double under = depth(p) / per_mm;
                const double vault = smooth_cut(smooth_cut(fields.vault, -under, kRound_mm),
                                                -fields.temple, kTempleRound_mm);
                out = smooth_union(smooth_cut(out, -under, kRound_mm), vault, 4);
                out = smooth_cut(out, -fields.carved, 2.5);
                if (at_nose) out = smooth_union(out, nasal_bone_field(shapes, standard, under), 2);
            }
            return per_mm * smooth_union(out, fields.inner, 3);
        };
    };
    const auto box = [&](const Vec3& low_mm, const Vec3& high_mm) {
        // The box of the standard head, scaled to this head, with a margin for longer or wider heads
        Vec3 low = Vec3::Constant(1e9), high = -low;
        for (const auto& [id, at] : head.landmarks) {
            low = low.cwiseMin(at);
            high = high.cwiseMax(at);
        }
        const Vec3 min = head.mm(1) * (low_mm - Vec3::Constant(15)),
                   max = head.mm(1) * (high_mm + Vec3::Constant(15));
        return std::pair<Vec3, Vec3>(low.cwiseMax(min), high.cwiseMin(max));
    };
    const auto skull_at = [&](const Vec3& p_mm) { return skull_fields(shapes, p_mm); };
    const auto mandible_at = [&](const Vec3& p_mm) { return mandible_fields(shapes, p_mm); };
    Skull skull;
    const auto [low, high] = box({-80, -60, -100}, {80, 135, 120});
    skull.cranium = surface_of(field_of(skull_at, true), low, high, head.mm(step_mm));
    const auto [jaw_low, jaw_high] = box({-70, -110, -5}, {70, 10, 100});
    skull.mandible = surface_of(field_of(mandible_at, false), jaw_low, jaw_high, head.mm(step_mm));
    return skull;
}

}  // namespace risorius::face
