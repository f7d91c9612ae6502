// SPDX-License-Identifier: MIT
/// \file
/// Finds few keys for a recorded curve. Between keys the curve is linear, and no sample is farther from it than a tolerance.
///
/// From each key the next one is as far away as all samples between allow. The slopes that pass every one of them within the
/// tolerance form an interval, which shrinks from sample to sample. Source: Imai & Iri 1986, J. Inf. Process. 9(3), 159-162, for
/// curves whose keys are samples.
#pragma once

#include <vector>

#include "risorius/track/script.h"

namespace risorius::motion {

/// Times rise. Returns at least one key when there are samples; a curve that stays within the tolerance of its first value has one.
std::vector<track::Key> reduce_keys(const std::vector<double>& times_s,
                                    const std::vector<double>& values, double tolerance);

}  // namespace risorius::motion
