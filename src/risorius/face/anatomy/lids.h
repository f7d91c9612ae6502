// SPDX-License-Identifier: MIT
/// \file
/// Eyelids: tarsal plates that turn about the axis through the canthi and the eye centre until the margins meet.
///
///   s      place along the axis, 0 at the inner, 1 at the outer canthus
///   angle  of a point about the axis, rad, 0 forward, positive up
///   A(s)   angle of a lid's margin at rest, measured on the mesh: there the skin in front of the eye ends
///   U, L   angles of the upper and the lower margin after gaze, wide opening and lift of the lower lid
///   M      angle of the line where the margins meet; fraction: the part of the way that the upper lid goes
///   closure   0: open, 1: closed
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

/// How far the lids of one eye have turned. The closures are fractions of the way to the line where the lids meet.
struct LidPose {
    double upper_closure = 0.0;
    double lower_closure = 0.0;
    double upper_gaze_rad = 0.0;  ///< positive lowers
    double lower_gaze_rad = 0.0;  ///< positive lowers
    double lower_lift = 0.0;      ///< lift of a tightened lower lid / height of the fissure
    double inward = 0.0;          ///< slide of the margins towards the nose / slide in a full blink
    double aside_rad = 0.0;       ///< sideways gaze; positive takes both lids to the subject's left
};

/// Position of a point on a lid, in the coordinates s and q.
struct LidMember {
    bool upper = true;
    double place = 0.0;   ///< s
    double height = 0.0;  ///< q, 0 on the margin and before it
    /// Fraction of the upper lid's motion that the point follows; the rest is that of the lower lid's.
    double fraction = 1.0;
    double beyond = 0.0;  ///< distance beyond the canthi, m
};

/// The two lids of one eye: their margins at rest, and the motion of points that are attached to them.
class EyeLids {
  public:
    /// `side`: 0 left, 1 right. `upper_fraction`: the part of the way between the margins that the upper lid goes in a blink.
    EyeLids(const rig::Head& head, int side, double upper_fraction);

    /// Returns the position of a point p at rest, m, on the lids.
    LidMember member(const Vec3& p) const;
    /// Returns how firmly a point is attached to its tarsal plate, 0..1. It is 1 up to the height q `upper_core` or `lower_core`, and
    /// falls to 0 at `upper_end` or `lower_end`, and beyond the canthi.
    static double firmness(const LidMember& member, double upper_core, double upper_end,
                           double lower_core, double lower_end);
    /// Returns the distance of p from the nearer margin at rest, m.
    double margin_distance(const Vec3& p) const;

    /// Returns the displacement, m, of a point with rest position `rest` that is attached to its lid.
    Vec3 ride(const Vec3& rest, const LidMember& member, const LidPose& pose) const;

    double fissure_m() const { return fissure_m_; }  ///< from canthus to canthus
    double zone_m() const { return zone_m_; }  ///< mean distance of the canthi from the eye centre
    const Vec3& centre() const { return centre_; }
    const Vec3& axis() const { return axis_; }
    const std::vector<Vec3>& upper_margin() const { return upper_; }
    const std::vector<Vec3>& lower_margin() const { return lower_; }
    double place_of(const Vec3& p) const;  ///< s
    double angle_of(const Vec3& p) const;  ///< rad
    /// Angles A of the margins at rest at the place s, rad.
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
    double beyond_m(double place) const;  // distance beyond the canthi
    double slide_m(double place, bool upper, const LidPose& pose) const;
    double upper_turn(const LidMember& member, const LidPose& pose) const;
    double lower_turn(const LidMember& member, const LidPose& pose) const;

    Vec3 centre_, axis_, forward_, up_;
    double inner_, outer_;  // places of the canthi along the axis, m
    double fissure_m_, zone_m_;
    double upper_fraction_;
    double to_left_;                       // 1 if the axis points to the subject's left, else -1
    double millimetre_;                    // a millimetre of the standard head on this head, m
    double crease_angle_, lower_reach_m_;  // where the lids end
    std::vector<Vec3> upper_, lower_;      // margins from inner to outer canthus, through landmarks
    std::vector<double> upper_angle_, lower_angle_, wide_gap_;  // tables over s
};

}  // namespace risorius::face
