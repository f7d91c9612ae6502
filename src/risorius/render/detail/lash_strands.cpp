// SPDX-License-Identifier: MIT
#include "risorius/render/detail/lash_strands.h"

#include <algorithm>
#include <cmath>

namespace risorius::render {
namespace {

/// Azimuth, rad, within which the width of a ribbon is taken as constant
constexpr double kWindow_rad = 0.12;

constexpr double kLidRadius_m = 0.0135;  ///< turns azimuth into length along the lid

struct Lash {
    std::size_t vertex;
    int eye;
    bool lower;
    double azimuth, radius;
};

}  // namespace

std::vector<LashPlace> lash_places(const Scene& scene) {
    std::vector<LashPlace> places(static_cast<std::size_t>(scene.rest.rows()));
    for (const Surface& surface : scene.surfaces)
        if (surface.material == Material::kLashes)
            for (Eigen::Index i = 0; i < surface.triangles.size(); ++i)
                places[static_cast<std::size_t>(surface.triangles.data()[i])].is_lash = true;

    // Seen from the centre of the eye, hairs grow radially outwards.
    std::vector<Lash> lashes;
    for (std::size_t v = 0; v < places.size(); ++v) {
        if (!places[v].is_lash) continue;
        const Vec3 p = scene.rest.row(static_cast<Eigen::Index>(v)).transpose();
        const Vec3 from_left = p - scene.eyes[0].centre, from_right = p - scene.eyes[1].centre;
        const int eye = from_left.norm() <= from_right.norm() ? 0 : 1;
        const Vec3 d = eye == 0 ? from_left : from_right;
        lashes.push_back({v, eye, d.y() < 0, std::atan2(d.x(), d.z()), d.norm()});
    }
    for (const Lash& lash : lashes) {
        // Root and tip are the nearest and the farthest vertex of the ribbon around this azimuth.
        double root = lash.radius, tip = lash.radius;
        for (const Lash& other : lashes) {
            if (other.eye != lash.eye || other.lower != lash.lower ||
                std::abs(other.azimuth - lash.azimuth) > kWindow_rad)
                continue;
            root = std::min(root, other.radius);
            tip = std::max(tip, other.radius);
        }
        LashPlace& place = places[lash.vertex];
        place.lower_lid = lash.lower;
        place.along_m = static_cast<float>((lash.azimuth + 4.0) * kLidRadius_m);
        place.fraction = static_cast<float>(tip > root ? (lash.radius - root) / (tip - root) : 0.0);
    }
    return places;
}

}  // namespace risorius::render
