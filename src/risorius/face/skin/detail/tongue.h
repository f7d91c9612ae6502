// SPDX-License-Identifier: MIT
/// \file
/// The tongue as a body that bends along its middle line. Its root is fixed, the rest moves with the mandible. It stretches forwards,
/// raises or lowers its tip, and passes between teeth and lips. Where there is little room between them, it is flattened. Its body
/// rises to the palate (tongue_body.h), and its tip to the ridge behind the upper teeth (tongue_tip.h).
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/skin/detail/tongue_body.h"
#include "risorius/face/skin/detail/tongue_tip.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// What moves the tongue.
struct TongueDrive {
    double out = 0;        ///< protrusion / its range, 0..1
    double up = 0;         ///< tip, -1..1; kTipAtRidge: at the ridge behind the teeth, -1 lowered
    double body_up = 0;    ///< -1..1; 1: its back touches the palate
    double body_back = 0;  ///< -1..1; where the body is highest, 1 at the soft palate
    Rigid mandible = Rigid::Identity();
};

/// The tongue of one head.
class Tongue {
  public:
    /// `range_m`: how far the tip moves forwards when TongueDrive::out is 1.
    Tongue(const rig::Head& head, double range_m);

    /// Moves the tongue's rows of `vertices`, in which the skin has already moved.
    void place(const TongueDrive& drive, Points& vertices) const;

    bool empty() const { return members_.empty(); }
    /// Returns the fraction of the protrusion for which there is room between the teeth, 0..1.
    double room(const TongueDrive& drive) const;

  private:
    struct Member {
        int vertex;
        double along;            ///< 0 at the root, 1 at the tip
        double side, up, ahead;  ///< offsets from the middle line in its local frame at rest, m
    };
    struct Line {
        std::vector<Vec3> point;
        Vec3 at(double along) const;
        Vec3 tangent(double along) const;  ///< unit, upright and forward parts only
    };
    struct Gate {
        double lower_y, upper_y, z;
    };
    Gate teeth(const Rigid& mandible) const;
    Line bent(const TongueDrive& drive, double out) const;
    std::vector<TongueSection> sections() const;

    const rig::Head& head_;
    double range_m_, length_m_ = 0, thickness_m_ = 0;
    Line rest_;
    std::vector<double> over_jaw_;  // per sample of the line, fraction of the mandible's motion
    std::vector<Member> members_;
    TongueBody body_;
    TongueTip tip_;
    Vec3 lower_edge_, upper_edge_;            // of the incisors
    std::vector<int> lower_lip_, upper_lip_;  // skin vertices at the landmarks stoi, stos
};

}  // namespace risorius::face
