// Where the head is, and how its turn spreads down the neck: whole above the jaw line, none at the neck's base.
#pragma once

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/track/channels.h"

namespace risorius::face {

/// Motion of the head from rest that its channels ask for: turns about the atlanto-occipital joint, then shifts.
Rigid head_motion(const rig::Head& head, const track::Drive& drive);

class Neck {
  public:
    explicit Neck(const rig::Head& head);

    /// How much of the head's motion a soft point takes, 0..1.
    double share(const Vec3& rest) const;
    /// What a point of that share takes of it: part of the turn about the same pivot, part of the shift.
    Rigid part(const Rigid& head, double share) const;

  private:
    Vec3 pivot_;
    double top_m_, chin_m_, base_m_, front_near_m_, front_far_m_;
};

}  // namespace risorius::face
