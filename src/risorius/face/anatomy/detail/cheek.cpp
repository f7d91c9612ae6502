// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/detail/cheek.h"

#include <algorithm>
#include <string>

#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr double kCreaseCore_mm = 3.5, kCrease_mm = 7.0;
constexpr double kFatCore_mm = 12.0, kFat_mm = 24.0;

}  // namespace

CheekRegions::CheekRegions(const rig::Head& head) : mm_(head.mm(1)) {
    for (const int side : {0, 1}) {
        const double out = side == 0 ? mm_ : -mm_;
        const auto at = [&](const char* id, double outwards, double up) {
            return Vec3(head.landmark(std::string(id) + (side == 0 ? "_l" : "_r")) +
                        Vec3(out * outwards, mm_ * up, 0));
        };
        // The landmarks lie at the bottom of the fold; the skin beside it folds
        crease_[side] = geom::sample_curve({at("ac", 6.5, 7), at("nl1", 4, 2), at("nl2", 4, 2.4),
                                            at("nl3", 4, 2), at("nl3", 7, -9)},
                                           2 * mm_);
        fat_[side] = at("ma", -2, -10);
    }
}

double CheekRegions::crease(const Vec3& p) const {
    const double away = std::min(geom::distance_to_polyline(p, crease_[0]),
                                 geom::distance_to_polyline(p, crease_[1]));
    return 1.0 - geom::smoothstep(kCreaseCore_mm * mm_, kCrease_mm * mm_, away);
}

double CheekRegions::fat(const Vec3& p) const {
    const double away = std::min((p - fat_[0]).norm(), (p - fat_[1]).norm());
    const double fraction = 1.0 - geom::smoothstep(kFatCore_mm * mm_, kFat_mm * mm_, away);
    return fraction > 0 ? fraction * (1.0 - crease(p)) : 0.0;
}

}  // namespace risorius::face
