// SPDX-License-Identifier: MIT
/// \file
/// Muscle excitations for the channels jaw_open, jaw_forward and jaw_side when muscles move the jaw. A group of muscles pulls
/// together, just so hard that the jaw comes to rest about where the kinematic channels would place it.
///
///   opening    lateral pterygoid (inferior), digastric, geniohyoid, mylohyoid
///   forwards   lateral pterygoid (both heads), a little masseter and medial pterygoid to keep the teeth near
///   backwards  temporalis (posterior, middle)
///   sideways   lateral and a little medial pterygoid of the opposite side, temporalis (posterior, middle) of the same side
///
/// The constructor applies each group at increasing levels of excitation to the jaw of this head, with the tissue around it as a spring, and
/// notes the movement. The level for a wanted movement is interpolated between these samples. The excitations of the groups are added.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw_dynamics.h"
#include "risorius/track/channels.h"

namespace risorius::face {

/// The synergies of one head: excitations as a function of the three channels.
class JawSynergies {
  public:
    /// Movements of the kinematic jaw when jaw_open, jaw_forward and jaw_side are 1, as in JawPlace, m.
    struct Ranges {
        double open_m, forward_m, side_m;
    };
    /// `tissue`: stiffness of the tissue in the mandible's coordinates, N/m.
    JawSynergies(const JawDynamics& jaw, const track::ChannelTable& channels, const Ranges& ranges,
                 const JawMatrix& tissue);

    /// Returns the excitation per column, 0..1. The arguments are the values of the channels.
    Eigen::VectorXd excitation(double open, double forward, double side) const;

  private:
    enum Group { kOpening, kForwards, kBackwards, kLeft, kRight, kGroups };
    struct Sample {
        double moved;  // movement / its range
        double level;  // factor on the pattern of the group
    };
    double level(Group group, double moved) const;

    std::array<Eigen::VectorXd, kGroups> pattern_;
    std::array<std::vector<Sample>, kGroups> samples_;
};

}  // namespace risorius::face
