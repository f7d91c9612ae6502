// SPDX-License-Identifier: MIT
/// \file
/// Moves the parts of the mesh that are not simulated tissue: lids on their tarsal plates over the moving cornea, eyes, teeth, tongue,
/// lashes, and the neck between the moving head and the shoulders.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/skin/detail/head_motion.h"
#include "risorius/face/skin/detail/skin_binding.h"
#include "risorius/face/skin/detail/tongue.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// What moves these parts.
struct FollowDrive {
    Rigid mandible = Rigid::Identity();  ///< motion from rest, head frame
    std::array<Mat3, 2> gaze;            ///< rotation of each eye in the head
    std::array<LidPose, 2> lid;
    double tongue_out = 0, tongue_up = 0;  ///< see TongueDrive
    double tongue_body_up = 0, tongue_body_back = 0;
    Rigid head = Rigid::Identity();  ///< motion from rest
};

/// The parts of one head that follow.
class RigidFollowers {
  public:
    /// Attaches the lashes to the skin through `binding`.
    RigidFollowers(const rig::Head& head, const rig::RigDescription& rig,
                   const std::array<EyeLids, 2>& lids, SkinBinding& binding);

    /// Moves the parts in `vertices` (V x 3, m), in which the skin has already moved, and then everything with the head.
    void apply(const FollowDrive& drive, Points& vertices) const;

    /// The last steps of apply() alone, for vertices that something other than the simulation has moved. turn_eyes() rotates the eyes by
    /// `gaze`; turn_head() moves everything with the head.
    void turn_eyes(const std::array<Mat3, 2>& gaze, Points& vertices) const;
    void turn_head(const Rigid& head, Points& vertices) const;

    /// Applies the motion of the head to soft points of head and neck, in place. `rest`: their positions at rest,
    /// which decide what fraction of the motion they follow.
    void turn_with_head(const Rigid& head, const Points& rest, Points& points) const;

    const std::vector<double>& head_fractions() const { return head_fraction_; }
    const Neck& neck() const { return neck_; }

  private:
    struct LidVertex {
        int vertex;
        int side;
        LidMember member;
        double weight;        ///< 1 on the tarsal plate, 0 where tissue alone moves it
        double clearance;     ///< distance kept from the eye's surface, m
        double hollow_m = 0;  ///< depth of the fold of the upper lid, which a closing lid unfolds
    };
    void measure_folds();  ///< `hollow_m` of all lid vertices so far
    void apply_lids(const FollowDrive& drive, Points& vertices) const;

    const rig::Head& head_;
    Neck neck_;
    const std::array<EyeLids, 2>& lids_;
    Points rest_;
    std::vector<LidVertex> lid_vertices_;
    Tongue tongue_;
    /// A vertex, and its fraction of the mandible's motion.
    std::vector<std::pair<int, double>> on_jaw_;
    std::array<std::vector<int>, 2> eye_;
    std::vector<double> head_fraction_;  ///< V, fraction of the head's motion
};

}  // namespace risorius::face
