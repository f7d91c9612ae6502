// Rigid things that soft objects touch, as signed distances: plane, sphere, capsule, closed mesh.
#pragma once

#include "core/types.h"

namespace risorius::contact {

struct Distance {
    double gap_m;  ///< negative inside
    Vec3 normal;   ///< of length 1, out of the obstacle
};

/// May be moved by its owner between steps.
class Obstacle {
  public:
    virtual ~Obstacle() = default;
    virtual Distance distance(const Vec3& p) const = 0;
    /// Of the obstacle's surface at p, m/s.
    virtual Vec3 velocity(const Vec3& p) const = 0;
};

}  // namespace risorius::contact
