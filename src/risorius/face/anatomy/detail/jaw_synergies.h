// SPDX-License-Identifier: MIT
/// \file
/// Muscle excitations for the channels jaw_open, jaw_forward and jaw_side when muscles move the jaw. Groups of muscles pull together, as
/// hard as is needed for the jaw to come to rest about where the kinematic channels would put it.
///
///   opening    lateral pterygoid (inferior), digastric, geniohyoid, mylohyoid
///   forwards   lateral pterygoid (both heads), a little masseter and medial pterygoid to keep the teeth near
///   backwards  temporalis (posterior, middle)
///   sideways   lateral and a little medial pterygoid of the other side, temporalis (posterior, middle) of this side
/// Each group is tried at rising levels on the jaw of this head, with the tissue around it as a spring. The level for a movement is
/// interpolated between them. Groups are added.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw_dynamics.h"
#include "risorius/track/channels.h"

namespace risorius::face {

class JawSynergies {
  public:
    /// Movements of the incisors that jaw_open, jaw_forward and jaw_side mean at 1, m, as in the kinematic jaw.
    struct Ranges {
        double open_m, forward_m, side_m;
    };
    /// `tissue`: stiffness of the tissue in the mandible's coordinates, N/m.
    JawSynergies(const JawDynamics& jaw, const track::ChannelTable& channels, const Ranges& ranges,
                 const JawMatrix& tissue);

    /// Per column, [0, 1].
    Eigen::VectorXd excitation(double open, double forward, double side) const;

  private:
    enum Group { kOpening, kForwards, kBackwards, kLeft, kRight, kGroups };
    struct Sample {
        double moved;  // movement / its range
        double level;
    };
    double level(Group group, double moved) const;

    std::array<Eigen::VectorXd, kGroups> pattern_;
    std::array<std::vector<Sample>, kGroups> samples_;
};

}  // namespace risorius::face
