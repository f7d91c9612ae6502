// SPDX-License-Identifier: MIT
/// \file
/// Published tables of force curves, to draw and to compare with the curves of this folder. Lengths and strains are as in
/// muscle_curves.h.
///
/// Source: F. E. Zajac, Crit. Rev. Biomed. Eng. 17(4), 1989, and S. L. Delp, Stanford 1990, with the digits of OpenSim's
/// RigidTendonMuscle.
#pragma once

#include <utility>
#include <vector>

namespace risorius::muscle {

/// Pairs (x, f) with growing x.
using PublishedTable = std::vector<std::pair<double, double>>;

/// Active force over l, without its zero tails; its peak is 0.993 at l = 1.045.
const PublishedTable& published_active_force();
/// Passive force over l.
const PublishedTable& published_passive_force();
/// Force over v: Hill's hyperbola for v < 0, and steeper than the curves here for v > 0.
const PublishedTable& published_velocity_force();

}  // namespace risorius::muscle
