// SPDX-License-Identifier: MIT
/// \file
/// Numbers of the standard anatomy that calibration may change: attachments, muscle paths and strengths, tissue. All are
/// relative to landmarks or to head size, so that what one measured head teaches carries to others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "risorius/rig/rig_description.h"

namespace risorius::calibrate {

struct Parameter {
    std::string name;
    double spread;  ///< how far from the published value it may plausibly lie, standard deviation
    double step;    ///< for differences
    double max;     ///< |value| at most
    std::function<void(rig::RigDescription&, double value)> add;  ///< value 0: as it is
};

std::vector<Parameter> anatomy_parameters(const rig::RigDescription& rig);

rig::RigDescription changed(const rig::RigDescription& rig,
                            const std::vector<Parameter>& parameters,
                            const Eigen::VectorXd& values);

}  // namespace risorius::calibrate
