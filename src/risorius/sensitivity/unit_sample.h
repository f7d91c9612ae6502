// SPDX-License-Identifier: MIT
/// \file
/// Points in the unit cube at which something is evaluated.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace risorius::sensitivity {

enum class Sampling {
    kSobol,  ///< sobol_sequence.h, every coordinate shifted at random by the seed (XOR of its binary digits)
    kLatinHypercube,  ///< McKay, Beckman & Conover 1979, Technometrics 21, 239-245
    kRandom
};

/// Returns `count` points, count x dimensions, all numbers in (0, 1). Up to SobolSequence::kMaxDimensions dimensions for kSobol. The
/// first points of kSobol and kRandom do not depend on `count`.
Eigen::MatrixXd unit_sample(Sampling sampling, int count, int dimensions, std::uint64_t seed);

}  // namespace risorius::sensitivity
