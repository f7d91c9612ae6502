// SPDX-License-Identifier: MIT
/// \file
/// Tables of force curves as published, to draw and to compare the curves of this folder with. Lengths and strains as in
/// muscle_curves.h.
///
/// Source: F. E. Zajac, Crit. Rev. Biomed. Eng. 17(4), 1989, and S. L. Delp, Stanford 1990, in the digits OpenSim's
/// RigidTendonMuscle carries.
#pragma once

#include <utility>
#include <vector>

namespace risorius::muscle {

/// (x, f), x growing.
using PublishedTable = std::vector<std::pair<double, double>>;

/// Active force over l, between the ends of its rise and fall; its peak is 0.993 at l = 1.045.
const PublishedTable& published_active_force();
/// Passive force over l.
const PublishedTable& published_passive_force();
/// Force over v; Hill's hyperbola for v < 0, steeper than ours for v > 0.
const PublishedTable& published_velocity_force();

}  // namespace risorius::muscle
