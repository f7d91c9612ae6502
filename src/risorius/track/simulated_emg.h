// SPDX-License-Identifier: MIT
/// \file
/// Simulated linear envelopes of surface electrodes above every muscle: columns of the frame table.
///
///   e = (u - min) / (1 - min)      electrical activity, ratio of the greatest; u excitation, min 0 or, of a muscle with
///                                  resting tone that can be taken away, -1
///   envelope                       e through a low-pass of 6 Hz, second order forwards and backwards, as EMG is processed
///
/// Amplitude is taken as proportional to excitation (A. L. Hof, Jw. van den Berg 1981, J. Biomech. 14(11), 747-758).
/// Electrical activity is simultaneous with excitation and precedes force: the delay between the two is that of the
/// activation dynamics, which the table shows beside it. Neither noise nor cross-talk nor electrodes are simulated. A muscle
/// whose activation is set directly has the excitation that would hold it.
#pragma once

#include <deque>
#include <functional>
#include <vector>

#include "risorius/track/channels.h"

namespace risorius::track {

class SimulatedEmg {
  public:
    using DriveAt = std::function<Drive(double t_s)>;

    /// `drive` is evaluated up to half a second before and after the time; for times before 0 at 0.
    SimulatedEmg(const ChannelTable& channels, DriveAt drive);

    /// Envelope of every column, [0, 1]. Increasing times need a few evaluations of the drive each.
    Eigen::VectorXd at(double t_s);

  private:
    const Eigen::VectorXd& activity(long sample);
    Eigen::VectorXd envelope(long sample);

    DriveAt drive_;
    Eigen::VectorXd min_;
    std::vector<double> kernel_;            ///< of the filter, symmetric
    std::deque<Eigen::VectorXd> activity_;  ///< e from first_ on
    long first_ = 0;
};

}  // namespace risorius::track
