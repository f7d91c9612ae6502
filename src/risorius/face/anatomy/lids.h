// SPDX-License-Identifier: MIT
/// \file
/// Eyelids: tarsal plates that turn about the axis through the canthi and the eye centre until the margins meet.
///
///   s      place along the canthal axis, 0 at the inner, 1 at the outer canthus
///   angle  of a point about the axis, rad, 0 forward, positive up
///   A(s)   angle of a lid's margin at rest, measured on the mesh where skin ends before the eye
///   q      height over the margin: 1 at the crease of the upper lid, 1 where the lower lid ends
///
/// Gaze, wide opening and a tightened lower lid shape the curve of each margin. Both margins then close on the line where they meet:
///   upper(s) = U(s) + closure (M(s) - U(s)),  M = L + (1 - fraction) (U - L)
/// A margin point slides along its curve, inwards in a blink and sideways with the gaze, so that closed lids meet in every gaze.
/// The skin of the plate turns with gaze as one piece up to the crease. When the eye closes, it unrolls from below the crease.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"

namespace risorius::face {

/// How far each lid has turned: fraction of the way to the line where lids meet, plus angles that follow gaze.
struct LidPose {
    double upper_closure = 0.0;
    double lower_closure = 0.0;
    double upper_gaze_rad = 0.0;  ///< positive lowers
    double lower_gaze_rad = 0.0;  ///< positive lowers
    double lower_lift = 0.0;      ///< of a tightened lower lid, ratio of the fissure's height
    double inward = 0.0;          ///< ratio of the way margins slide to the nose in a full blink
    double aside_rad = 0.0;       ///< positive takes both lids to the subject's left
};

/// Position of a point on a lid.
struct LidMember {
    bool upper = true;
    double place = 0.0;     ///< s
    double height = 0.0;    ///< q, 0 on the margin and before it
    double fraction = 1.0;  ///< fraction of the upper lid's motion; the rest is the lower lid's
    double beyond = 0.0;    ///< distance beyond the canthi, m
};

class EyeLids {
  public:
    EyeLids(const rig::Head& head, int side, double upper_fraction);

    LidMember member(const Vec3& p) const;
    /// How firmly a point is attached to its tarsal plate: 1 on the margin, 0 where the lid ends and beyond the canthi. The bounds are
    /// heights q.
    static double firmness(const LidMember& member, double upper_core, double upper_end,
                           double lower_core, double lower_end);
    double margin_distance(const Vec3& p) const;

    /// Displacement of a point at rest that is attached to its lid, m.
    Vec3 ride(const Vec3& rest, const LidMember& member, const LidPose& pose) const;

    double fissure_m() const { return fissure_m_; }  ///< canthus to canthus
    double zone_m() const { return zone_m_; }        ///< distance of the canthi from the eye centre
    const Vec3& centre() const { return centre_; }
    const Vec3& axis() const { return axis_; }
    const std::vector<Vec3>& upper_margin() const { return upper_; }
    const std::vector<Vec3>& lower_margin() const { return lower_; }
    double place_of(const Vec3& p) const;
    double angle_of(const Vec3& p) const;
    double upper_angle(double place) const { return at(upper_angle_, place); }
    double lower_angle(double place) const { return at(lower_angle_, place); }

  private:
    double at(const std::vector<double>& table, double place) const;
    double margin_angle(const std::vector<Vec3>& margin, double place) const;
    void measure_margins(const rig::Head& head);
    void widen_gap();

    struct Curves {
        double upper, lower;  // angles of the margins' curves
    };
    double gaze_turn(double place, double own_rad, double other_rad) const;
    Curves curves(double place, const LidPose& pose) const;
    double beyond_m(double place) const;  // the canthi
    double slide_m(double place, bool upper, const LidPose& pose) const;
    double upper_turn(const LidMember& member, const LidPose& pose) const;
    double lower_turn(const LidMember& member, const LidPose& pose) const;

    Vec3 centre_, axis_, forward_, up_;
    double inner_, outer_;  // places of the canthi along the axis, m
    double fissure_m_, zone_m_;
    double upper_fraction_;
    double to_left_;                       // along the axis
    double millimetre_;                    // of the atlas head, on this head, m
    double crease_angle_, lower_reach_m_;  // where the lids end
    std::vector<Vec3> upper_, lower_;      // margins from inner to outer canthus, by landmarks
    std::vector<double> upper_angle_, lower_angle_, wide_gap_;  // tables over s
};

}  // namespace risorius::face
