// SPDX-License-Identifier: MIT
/// \file
/// Published tables of the force-length and force-velocity curves. They are drawn and compared with the curves of this folder.
/// l, v and f are those of muscle_curves.h.
///
/// Source: F. E. Zajac, Crit. Rev. Biomed. Eng. 17(4), 1989, and S. L. Delp, Stanford 1990, with the digits of OpenSim's
/// RigidTendonMuscle.
#pragma once

#include <utility>
#include <vector>

namespace risorius::muscle {

/// Pairs (x, f), x ascending.
using PublishedTable = std::vector<std::pair<double, double>>;

/// Active force over l, without the ranges where it is zero; its peak is 0.993 at l = 1.045.
const PublishedTable& published_active_force();
/// Passive force over l.
const PublishedTable& published_passive_force();
/// Force over v. For v < 0 it is Hill's hyperbola; for v > 0 it is steeper than the curves of this folder.
const PublishedTable& published_velocity_force();

}  // namespace risorius::muscle
