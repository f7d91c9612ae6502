// SPDX-License-Identifier: MIT
/// \file
/// Motion of the head, and how it fades down the neck: full above the jaw line, zero at the base of the neck.
#pragma once

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/track/channels.h"

namespace risorius::face {

/// Returns the motion of the head from rest that the channels ask for: a rotation about the atlanto-occipital joint, then a translation.
Rigid head_motion(const rig::Head& head, const track::Drive& drive);

/// The fraction of the head's motion that each point of head and neck follows.
class Neck {
  public:
    explicit Neck(const rig::Head& head);

    /// Returns the fraction of the head's motion that a soft point with the rest position `rest` (m) follows, 0..1.
    double fraction(const Vec3& rest) const;
    /// Returns a fraction of a motion of the head: this fraction of the rotation about the same pivot, and of the translation.
    Rigid part(const Rigid& head, double fraction) const;
    const Vec3& pivot() const { return pivot_; }

  private:
    Vec3 pivot_;
    double top_m_, chin_m_, base_m_, front_near_m_, front_far_m_;
};

}  // namespace risorius::face
