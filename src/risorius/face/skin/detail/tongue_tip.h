// SPDX-License-Identifier: MIT
/// \file
/// The tip of the tongue at the ridge behind the upper teeth, as in t, d, n and l: however far the jaw is open, the tip touches the
/// ridge, and the blade follows it. Points move along with the tip, so that the tongue keeps its thickness and its volume.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/skin/detail/tongue_body.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// Channel tongue_up at which the tip touches the ridge.
inline constexpr double kTipAtRidge = 0.8;

/// Where the ridge of one head is, and how the tongue comes to it.
class TongueTip {
  public:
    TongueTip() = default;
    /// `upper_edge`: of the upper incisors; `length_m`: of the tongue. A head without teeth gets an estimate from where it would be.
    TongueTip(const rig::Head& head, const Vec3& upper_edge, double length_m);

    /// Moves all points. `up`: the channel, [-1, 1]; `share`: how much of this, [0, 1]; 0 for a tongue that is out.
    void raise(double up, double share, std::vector<TonguePoint>& points) const;

    const Vec3& ridge() const { return ridge_; }

  private:
    Vec3 ridge_ = Vec3::Zero();
    double reach_m_ = 0, length_m_ = 1;
};

}  // namespace risorius::face
