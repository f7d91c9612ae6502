// SPDX-License-Identifier: MIT
/// \file
/// The drive of a script over time for a face that is not stepped: muscle excitation has become activation through activation
/// dynamics, other channels are as in the script.
#pragma once

#include "risorius/muscle/activation.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"

namespace risorius::scene {

class ScriptDrives {
  public:
    ScriptDrives(const track::ScriptDescription& script, const rig::RigDescription& rig);

    /// The drive at a time, whose `excitation` is activation. Times must ascend from call to call; muscles begin in the steady state
    /// of time 0.
    track::Drive at(double t_s);

  private:
    /// The activation that a constant drive leads to.
    Eigen::VectorXd steady(const track::Drive& drive) const;

    track::Timeline timeline_;
    muscle::ActivationDynamics dynamics_;
    bool at_once_;  ///< quasi-static script: activation equals excitation
    double time_s_ = 0;
};

}  // namespace risorius::scene
