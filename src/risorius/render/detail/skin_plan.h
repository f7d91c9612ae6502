// SPDX-License-Identifier: MIT
/// \file
/// Positions of lips, redness, hairline, brows, beard and ears on a head, derived from its landmarks. Parts without landmarks are
/// omitted.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "risorius/render/scene.h"

namespace risorius::render {

/// A spot of another tint with a soft edge. At its centre, the albedo is multiplied by exp(log_tint), channel by channel.
struct SkinZone {
    Vec3 centre;      ///< rest, m
    double spread_m;  ///< standard deviation
    Vec3 log_tint;
    double oil;  ///< added oil, which makes the skin glossy
};

/// The skin of an ear: the points inside a box that lie in the bowl of the ear or outside of a plane. The plane leans outwards
/// towards the back and the top, as the auricle does.
struct EarRegion {
    bool known = false;
    Vec3 low, high;      ///< rest, m
    double out_m = 0.0;  ///< |x| of the plane at the front of the box
    double lean = 0.0;   ///< increase of that |x| per metre backwards and upwards
    bool contains(const Vec3& p) const;
    /// Whether the point lies in the box, behind its front: on the ear, its lobe, or the head below them, where no beard grows.
    bool has_beside(const Vec3& p) const;
};

struct SkinPlan {
    static constexpr int kHairlineSteps = 32;

    std::vector<SkinZone> zones;
    std::vector<Vec3> lip_outline;  ///< closed, rest, m; empty when not marked
    double lip_back_m = 0.0;        ///< lips lie in front of this z
    /// Radius on the paint map (0..0.5) beyond which hair grows, at equal steps of the angle from straight up towards the left;
    /// above 1: no hair.
    std::array<double, kHairlineSteps> hairline;
    /// The crown is bald where y + kRingSlope z is above this, rest, m
    double ring_m = 1e3;
    static constexpr double kRingSlope = 0.20;
    std::vector<SkinZone> beard;  ///< soft spots (centre and spread) with a beard
    bool trimmed = false;         ///< its hairs are millimetres long, and hide the skin
    std::array<EarRegion, 2> ears;
    std::array<std::vector<Vec3>, 2> brows;  ///< centre lines from medial to lateral, rest, m
};

SkinPlan plan_skin(const Scene& scene, const Vec3& paint_centre);

/// Density of a beard at a point of the skin, 0..1.
double beard_density(const SkinPlan& plan, const Vec3& rest);

/// Share of white hairs: what the appearance says, or else what comes with its age.
double white_share(const Appearance& appearance);
/// Share of the short hairs that are drawn white. Dark hairs swallow light that white ones scatter, so few white ones are hardly seen;
/// and brows turn grey later than the hair of the head.
inline double white_share_of_beard(const Appearance& appearance) {
    return std::pow(white_share(appearance), 1.6);
}
inline double white_share_of_brows(const Appearance& appearance) {
    return 0.75 * white_share_of_beard(appearance);
}
/// Whether a short hair is white. `draw`: any random number of the hair; its further digits decide
bool is_white_hair(double draw, double whites);

/// Tone of short hair (brows, beard, stubble) with its white hairs.
Vec3 hair_tone_at(const Appearance& appearance);
/// The same without white hairs.
Vec3 dark_hair_tone(const Appearance& appearance);

/// Tone of the lips with what the complexion adds, linear.
Vec3 lip_tone_at(const Appearance& appearance);

/// Whether the scalp lies under a cap of locks.
bool has_cap(const Appearance& appearance, const SkinPlan& plan);

/// How dark the scalp is painted, 0..1. Between locks it is as dark as their roots.
double scalp_paint(const Appearance& appearance);

/// Returns the radius on the map at which hair starts, in the direction of `place`, a position on the map.
double hairline_radius(const SkinPlan& plan, const Vec2& place);

/// Returns points on a Catmull-Rom curve through `knots`: `steps` per span between two knots, both ends of the curve included.
std::vector<Vec3> smooth_curve(const std::vector<Vec3>& knots, int steps);

}  // namespace risorius::render
