// SPDX-License-Identifier: MIT
#include "risorius/scene/script_drives.h"

#include <cmath>

namespace risorius::scene {

ScriptDrives::ScriptDrives(const track::ScriptDescription& script, const rig::RigDescription& rig)
    : timeline_(script, rig.channels()),
      dynamics_(rig.muscles.activation_s(), rig.muscles.deactivation_s(),
                {rig.activation.law == "smooth" ? muscle::ActivationLaw::Form::kSmooth
                                                : muscle::ActivationLaw::Form::kThelen2003,
                 rig.activation.steepness}),
      at_once_(script.header.motion == track::Motion::kQuasiStatic) {
    dynamics_.set_activation(steady(timeline_.at(0)));
}

Eigen::VectorXd ScriptDrives::steady(const track::Drive& drive) const {
    Eigen::VectorXd activation = drive.excitation;
    for (long i = 0; i < drive.activation.size(); ++i)
        if (!std::isnan(drive.activation[i])) activation[i] = drive.activation[i];
    return activation;
}

track::Drive ScriptDrives::at(double t_s) {
    track::Drive drive = timeline_.at(t_s);
    if (at_once_) {
        dynamics_.set_activation(steady(drive));
    } else if (t_s > time_s_) {
        Eigen::VectorXd excitation;
        dynamics_.advance(
            [&](double time) -> const Eigen::VectorXd& {
                excitation = timeline_.at(time).excitation;
                return excitation;
            },
            drive.activation, time_s_, t_s);
    }
    time_s_ = t_s;
    drive.excitation = dynamics_.activation();
    return drive;
}

}  // namespace risorius::scene
