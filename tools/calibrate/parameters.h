// SPDX-License-Identifier: MIT
/// \file
/// Parameters of the standard anatomy that calibration may change: attachments, muscle paths and strengths, tissue. All are
/// relative to landmarks or to head size, so that the result of one measured head applies to others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "risorius/rig/rig_description.h"

namespace risorius::calibrate {

struct Parameter {
    std::string name;
    double spread;  ///< standard deviation of plausible deviations from the published value
    double step;    ///< step of finite differences
    double max;     ///< largest |value|
    std::function<void(rig::RigDescription&, double value)> add;  ///< value 0: unchanged
};

std::vector<Parameter> anatomy_parameters(const rig::RigDescription& rig);

rig::RigDescription changed(const rig::RigDescription& rig,
                            const std::vector<Parameter>& parameters,
                            const Eigen::VectorXd& values);

}  // namespace risorius::calibrate
