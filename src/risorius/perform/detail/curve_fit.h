// SPDX-License-Identifier: MIT
/// \file
/// Explains a change as a sum of channels, each of which moves along a curve that two pictures give.
///
///   f(v)   what a channel does at the value v: straight from 0 to its column at one half, and on to its column at one
///   v      0..1, the least of |sum f(v) - d|^2 + sum w v^2
/// A network answers little to half a channel, and much to a whole one. Columns alone would take the small for a part of the large.
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::perform {

/// `columns`: n x 2 channels, at one half and at one. `weights`: w, one per channel. Coordinate descent from 0 in a fixed order: the
/// same bytes everywhere, and near a minimum, as the curves bend little.
Eigen::VectorXd curve_fit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& d,
                          const std::vector<double>& weights);

}  // namespace risorius::perform
