// SPDX-License-Identifier: MIT
/// \file
/// Scales the action units to a head: the weights of the muscles of a unit get one factor, so that its landmarks move as far as facs.json
/// asks of a head of this size, and a curve, so that they move evenly with the intensity.
///
/// Units of the jaw and of the pressure in the mouth get curves alone, one for their muscles and one for these channels, and units of the
/// lids are left as they are: how far these go does not depend on the strength of muscles. A weight ends at 1; what is then still missing
/// is reported.
#pragma once

#include <map>
#include <string>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/face_team.h"
#include "risorius/rig/rig_description.h"

namespace risorius::fitting {

/// Returns the gain of each unit that has targets and muscles, apart from lids. `rig` holds the units of the table, without gains of a
/// head. The faces are left in some pose. Throws Interrupted.
std::map<std::string, rig::UnitGain> fit_units(face::FaceTeam& team, const rig::RigDescription& rig,
                                               const ProgressMonitor& monitor);

}  // namespace risorius::fitting
