// SPDX-License-Identifier: MIT
/// \file
/// Something that drives a face besides channels, expressions and blinks, and that other modules make, such as speech. What it
/// asks of a muscle or channel is added to the others, and the sum is clamped.
#pragma once

#include "risorius/track/facs.h"

namespace risorius::track {

class DriveSource {
  public:
    DriveSource() = default;
    DriveSource(const DriveSource&) = delete;
    DriveSource& operator=(const DriveSource&) = delete;
    virtual ~DriveSource() = default;

    /// Adds to what the sources of the script ask for at a time, s. May be called from several threads.
    virtual void add(double t_s, Expansion& sum) const = 0;

    /// Multiplies `factor`, one entry per column, by how much of the expressions' excitation is left at a time: below 1 where this
    /// source must have its way, such as the lips of a smile in p.
    virtual void weaken_expressions(double t_s, Eigen::VectorXd& factor) const {
        (void)t_s;
        (void)factor;
    }
};

}  // namespace risorius::track
