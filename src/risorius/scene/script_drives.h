// What drives a face that is in equilibrium with a script at every moment: the script's excitations as what muscles have made of
// them by then, everything else as it stands.
#pragma once

#include "risorius/muscle/activation.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"

namespace risorius::scene {

class ScriptDrives {
  public:
    ScriptDrives(const track::ScriptDescription& script, const rig::RigDescription& rig);

    /// Times ascending, the first with muscles as the script begins. `excitation` of what comes back is activation.
    track::Drive at(double t_s);

  private:
    /// What activation comes to if the drive lasts.
    Eigen::VectorXd steady(const track::Drive& drive) const;

    track::Timeline timeline_;
    muscle::ActivationDynamics dynamics_;
    bool at_once_;  ///< a quasi-static script leaves muscles no time
    double time_s_ = 0;
};

}  // namespace risorius::scene
