// SPDX-License-Identifier: MIT
/// \file
/// Rays from the front onto a head that is upright and faces +z. Creases between lids or lips are seen as turns of the skin down a
/// column of rays.
#pragma once

#include <optional>

#include "risorius/landmarks/detail/shown_head.h"

namespace risorius::landmarks {

inline constexpr double kRayStep_m = 0.2e-3;  ///< between rays
inline constexpr double kTurnOver_m = 2e-3;   ///< length over which a turn of the skin is measured

/// What a ray from the front meets.
struct Sight {
    bool skin = false;
    double down_deg = 0;  ///< how far the skin faces down
    Vec3 at = Vec3::Zero();
};

/// A crease in a column of rays.
struct Crease {
    double turn_deg = 0;     ///< 180 where no skin is seen
    double y = 0;            ///< of the middle of the turn
    std::optional<Vec3> at;  ///< its deepest skin; nothing where no skin is seen
};

/// Where a crease is looked for.
struct CreaseSearch {
    double x, y;          ///< the column, and where the crease is expected
    double around_m;      ///< how far from there it may be
    double deg_per_m;     ///< a crease farther off has to turn by so much more
    double z;             ///< of the skin that is expected
    double flat_deg = 0;  ///< turns that are as near to the greatest belong to the same crease
};

class FrontRays {
  public:
    explicit FrontRays(const ShownHead& head);
    Sight sight(double x, double y, double z) const;
    Crease crease(const CreaseSearch& search) const;

  private:
    const ShownHead& head_;
    double outside_;  // +1 where the normals of the skin point out of the head, else -1
};

}  // namespace risorius::landmarks
