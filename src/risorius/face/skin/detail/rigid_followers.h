// Everything of the mesh that is not tissue: lids on their tarsal plates over the moving cornea, eyes, teeth, tongue, lashes,
// and the neck that joins the turning head to the shoulders.
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

struct FollowDrive {
    Rigid mandible = Rigid::Identity();
    std::array<Mat3, 2> gaze;
    std::array<LidPose, 2> lid;
    double tongue_out = 0, tongue_up = 0;
    Rigid head = Rigid::Identity();
};

class RigidFollowers {
  public:
    /// Binds lashes through `binding`.
    RigidFollowers(const rig::Head& head, const rig::RigDescription& rig,
                   const std::array<EyeLids, 2>& lids, SkinBinding& binding);

    /// `vertices` come with the skin already moved.
    void apply(const FollowDrive& drive, Points& vertices) const;

    /// The last parts of that, on vertices that something else has moved: eyes turned by `gaze`, and all with the head.
    void turn_eyes(const std::array<Mat3, 2>& gaze, Points& vertices) const;
    void turn_head(const Rigid& head, Points& vertices) const;

    /// The head's turn on soft points of the head and neck, in place; `rest` says how much of it each takes.
    void turn_with_head(const Rigid& head, const Points& rest, Points& points) const;

  private:
    struct LidVertex {
        int vertex;
        int side;
        LidMember member;
        double weight;     ///< 1 on the tarsal plate, 0 where tissue alone moves it
        double clearance;  ///< kept from the eye's surface, m
    };
    void apply_lids(const FollowDrive& drive, Points& vertices) const;

    const rig::Head& head_;
    Neck neck_;
    const std::array<EyeLids, 2>& lids_;
    Points rest_;
    std::vector<LidVertex> lid_vertices_;
    Tongue tongue_;
    std::vector<std::pair<int, double>> on_jaw_;  // vertex, share of the mandible's motion
    std::array<std::vector<int>, 2> eye_;
    std::vector<double> head_share_;  ///< V, of the head's turn
};

}  // namespace risorius::face
