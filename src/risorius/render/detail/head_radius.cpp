// SPDX-License-Identifier: MIT
#include "risorius/render/detail/head_radius.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace risorius::render {
namespace {

constexpr int kFaces = 6;

/// Where a direction meets the cube: its face, and the place on that, -1..1.
struct CubePlace {
    int face;
    double u, v;
};

CubePlace cube_place(const Vec3& direction) {
    Eigen::Index axis = 0;
    const double along = direction.cwiseAbs().maxCoeff(&axis);
    const auto face = static_cast<int>(2 * axis + (direction[axis] < 0 ? 1 : 0));
    return {face, direction[(axis + 1) % 3] / along, direction[(axis + 2) % 3] / along};
}

Vec3 cube_direction(int face, double u, double v) {
    const Eigen::Index axis = face / 2;
    Vec3 direction;
    direction[axis] = face % 2 == 0 ? 1 : -1;
    direction[(axis + 1) % 3] = u;
    direction[(axis + 2) % 3] = v;
    return direction.normalized();
}

}  // namespace

HeadRadius::HeadRadius(const Scene& scene, const SkinPlan& plan, const Vec3& centre)
    : centre_(centre), cells_(static_cast<std::size_t>(kFaces) * kSide * kSide) {
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != Material::kSkin) continue;
        for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
            SkinPlace triangle;
            std::array<Vec3, 3> corner;
            bool ear = true;
            for (std::size_t k = 0; k < 3; ++k) {
                triangle.corner[k] = surface.triangles(f, static_cast<Eigen::Index>(k));
                const Vec3 p = scene.rest.row(triangle.corner[k]).transpose();
                ear = ear && (plan.ears[0].contains(p) || plan.ears[1].contains(p));
                corner[k] = p - centre;
            }
            for (int face = 0; face < kFaces; ++face) fill(face, corner, triangle, ear);
        }
    }
}

std::size_t HeadRadius::index(int face, int x, int y) const {
    return (static_cast<std::size_t>(face) * kSide + static_cast<std::size_t>(y)) * kSide +
           static_cast<std::size_t>(x);
}

void HeadRadius::fill(int face, const std::array<Vec3, 3>& corner, const SkinPlace& triangle,
                      bool ear) {
    const Eigen::Index axis = face / 2;
    const double sign = face % 2 == 0 ? 1 : -1;
    Vec2 low(1e9, 1e9), high(-1e9, -1e9);
    for (const Vec3& p : corner) {
        const double along = sign * p[axis];
        if (along < 0.3 * p.norm()) return;  // beyond the neighbouring faces
        const Vec2 at(p[(axis + 1) % 3] / along, p[(axis + 2) % 3] / along);
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
    }
    const auto cell = [](double at) {
        return static_cast<int>(std::clamp(0.5 * (at + 1) * kSide - 0.5, -1e3, 1e3));
    };
    const Vec3 a = corner[0], e1 = corner[1] - a, e2 = corner[2] - a, normal = e1.cross(e2);
    for (int y = std::max(cell(low.y()), 0); y <= std::min(cell(high.y()) + 1, kSide - 1); ++y)
        for (int x = std::max(cell(low.x()), 0); x <= std::min(cell(high.x()) + 1, kSide - 1);
             ++x) {
            const Vec3 ray =
                cube_direction(face, 2 * (x + 0.5) / kSide - 1, 2 * (y + 0.5) / kSide - 1);
            const double facing = normal.dot(ray);
            if (std::abs(facing) < 1e-16) continue;
            const double away = normal.dot(a) / facing;
            if (away <= 0) continue;
            const Vec3 p = away * ray - a;
            const double s = normal.dot(p.cross(e2)) / normal.squaredNorm(),
                         t = normal.dot(e1.cross(p)) / normal.squaredNorm();
            if (s < -1e-9 || t < -1e-9 || s + t > 1 + 1e-9) continue;
            Cell& there = cells_[index(face, x, y)];
            if (!ear) there.without_ears_m = std::max(there.without_ears_m, away);
            if (away <= there.radius_m) continue;
            there.radius_m = away;
            there.ear = ear;
            there.place = triangle;
            there.place.fraction = {1 - s - t, s, t};
        }
}

const HeadRadius::Cell& HeadRadius::cell(const Vec3& direction) const {
    const CubePlace place = cube_place(direction);
    const auto at = [](double v) {
        return std::clamp(static_cast<int>(0.5 * (v + 1) * kSide), 0, kSide - 1);
    };
    return cells_[index(place.face, at(place.u), at(place.v))];
}

std::optional<SkinPlace> HeadRadius::skin_at(const Vec3& direction) const {
    const Cell& there = cell(direction);
    if (there.radius_m <= 0) return std::nullopt;
    return there.place;
}

bool HeadRadius::is_ear(const Vec3& direction) const { return cell(direction).ear; }

double HeadRadius::radius_m(const Vec3& direction, bool ears) const {
    const CubePlace place = cube_place(direction);
    const double u = std::clamp(0.5 * (place.u + 1) * kSide - 0.5, 0.0, kSide - 1.0),
                 v = std::clamp(0.5 * (place.v + 1) * kSide - 0.5, 0.0, kSide - 1.0);
    const int x = std::min(static_cast<int>(u), kSide - 2),
              y = std::min(static_cast<int>(v), kSide - 2);
    const double s = u - x, t = v - y;
    const auto at = [&](int i, int j) {
        const Cell& there = cells_[index(place.face, x + i, y + j)];
        return ears ? there.radius_m : there.without_ears_m;
    };
    return (1 - t) * ((1 - s) * at(0, 0) + s * at(1, 0)) + t * ((1 - s) * at(0, 1) + s * at(1, 1));
}

}  // namespace risorius::render
