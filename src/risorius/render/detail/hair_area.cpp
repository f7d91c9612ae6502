// SPDX-License-Identifier: MIT
#include "risorius/render/detail/hair_area.h"

#include <algorithm>
#include <limits>

#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

/// Distance to a polyline, and the position of the nearest point along it, 0..1.
std::pair<double, double> from_line(const std::vector<Vec3>& line, const Vec3& p) {
    double min = std::numeric_limits<double>::infinity(), along = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec3 e = line[i + 1] - line[i];
        const double t =
            std::clamp((p - line[i]).dot(e) / std::max(e.squaredNorm(), 1e-12), 0.0, 1.0);
        const double d = (p - line[i] - t * e).norm();
        if (d < min) {
            min = d;
            along = (static_cast<double>(i) + t) / static_cast<double>(line.size() - 1);
        }
    }
    return {min, along};
}

}  // namespace

HairArea::HairArea(const Scene& scene) {
    if (has_own_skin(scene)) return;
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (Eigen::Index v = 0; v < scene.rest.rows(); ++v) {
        low = low.cwiseMin(scene.rest.row(v).transpose());
        high = high.cwiseMax(scene.rest.row(v).transpose());
    }
    centre_ = paint_centre(scene, low, high);
    plan_ = plan_skin(scene, centre_);
    brow_width_ = scene.appearance.brow_width;
    scalp_ = std::max(scalp_paint(scene.appearance), scene.appearance.hair_length_mm) > 0 &&
             plan_.hairline[0] < 1;
}

std::optional<Part> HairArea::at(const Vec3& rest) const {
    for (const std::size_t side : {0U, 1U}) {
        const std::vector<Vec3>& line = plan_.brows[side];
        if (line.size() < 2 || (rest - line[line.size() / 2]).squaredNorm() > 0.04 * 0.04) continue;
        const auto [distance, along] = from_line(line, rest);
        // The width over which next_brow_hair() spreads roots, plus the reach of the hairs.
        if (distance < 0.0045 * brow_width_ * (1 - 0.58 * along))
            return side == 0 ? Part::kBrowLeft : Part::kBrowRight;
    }
    if (!scalp_ || plan_.ears[0].contains(rest) || plan_.ears[1].contains(rest))
        return std::nullopt;
    if (rest.y() + SkinPlan::kRingSlope * rest.z() > plan_.ring_m) return std::nullopt;
    const Vec2 place = paint_place(rest, centre_);
    if ((place - Vec2(0.5, 0.5)).norm() < hairline_radius(plan_, place)) return std::nullopt;
    return Part::kHair;
}

}  // namespace risorius::render
