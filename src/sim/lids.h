// Eyelids: tarsal plates that turn about the canthal axis through the eye centre until the margins meet.
//
//   s      place along the canthal axis, 0 at the inner, 1 at the outer canthus
//   angle  of a point about the axis, rad, 0 forward, positive up
//
// A point of the upper lid at (s, angle) closes by turning down to the meeting line; the lower lid rises the rest.
#pragma once

#include <array>
#include <vector>

#include "core/types.h"
#include "rig/head.h"

namespace risorius::sim {

/// How far each lid has turned: ratio of the way to the meeting line (negative: wide), plus an angle that follows gaze.
struct LidPose {
    double upper_closure = 0.0;
    double lower_closure = 0.0;
    double upper_gaze_rad = 0.0;  ///< positive lowers
    double lower_gaze_rad = 0.0;  ///< positive lowers
};

/// Where a vertex belongs to a lid, and how strongly it rides on the tarsal plate.
struct LidMember {
    int vertex;
    bool upper;
    double weight;  ///< 1 on the margin, 0 where the lid ends
    double place;   ///< s
};

class EyeLids {
  public:
    EyeLids(const rig::Head& head, int side, double upper_share);

    /// Weight of a point on the upper or lower tarsal plate: 1 within `core` of the margin, 0 beyond `fade` more, 0 at the canthi.
    LidMember classify(const Vec3& p, double core_m, double upper_fade_m,
                       double lower_fade_m) const;
    double margin_distance(const Vec3& p) const;

    /// Displacement of a rest point that rides rigidly on its lid.
    Vec3 ride(const Vec3& rest, bool upper, double place, const LidPose& pose) const;

    double fissure_m() const { return fissure_m_; }  ///< canthus to canthus
    double zone_m() const { return zone_m_; }        ///< distance of the canthi from the eye centre
    const Vec3& centre() const { return centre_; }
    const Vec3& axis() const { return axis_; }
    const std::vector<Vec3>& upper_margin() const { return upper_; }
    const std::vector<Vec3>& lower_margin() const { return lower_; }

  private:
    double place_of(const Vec3& p) const;
    double angle_of(const Vec3& p) const;
    double margin_angle(const std::vector<Vec3>& margin, double place) const;

    Vec3 centre_, axis_, forward_, up_;
    double inner_, outer_;  // places of the canthi along the axis, m
    double fissure_m_, zone_m_;
    double upper_share_;
    std::vector<Vec3> upper_, lower_;  // margins from inner to outer canthus
};

}  // namespace risorius::sim
