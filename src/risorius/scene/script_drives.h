// SPDX-License-Identifier: MIT
/// \file
/// The drive of a script over time for a face that is not simulated. Excitation is converted to activation by activation
/// dynamics; other channels are as in the script.
#pragma once

#include "risorius/muscle/activation.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"

namespace risorius::scene {

class ScriptDrives {
  public:
    ScriptDrives(const track::ScriptDescription& script, const rig::RigDescription& rig);

    /// Returns the drive at a time; its `excitation` holds activation. Times must ascend from call to call. Muscles start in the
    /// steady state of time 0.
    track::Drive at(double t_s);

  private:
    /// Returns the activation of every column that a constant drive approaches.
    Eigen::VectorXd steady(const track::Drive& drive) const;

    track::Timeline timeline_;
    muscle::ActivationDynamics dynamics_;
    bool at_once_;  ///< quasi-static script: activation equals excitation
    double time_s_ = 0;
};

}  // namespace risorius::scene
