// SPDX-License-Identifier: MIT
/// \file
/// Simulates electromyography (EMG): the linear envelopes that surface electrodes above every muscle would record. They are
/// columns of the frame table.
///
///   e = (u - min) / (1 - min)      electrical activity, fraction of the maximum; u excitation; min 0, or -1 for a muscle
///                                  with resting tone that can be reduced
///   envelope                       e after a low-pass of 6 Hz, second order forwards and backwards, as EMG is processed
///
/// The amplitude is proportional to excitation (A. L. Hof, Jw. van den Berg 1981, J. Biomech. 14(11), 747-758). Electrical
/// activity is simultaneous with excitation and precedes force. The delay between them is that of the activation dynamics,
/// whose result is also in the table. Noise, cross-talk and electrodes are not simulated. A muscle whose activation is set
/// directly has the excitation that would hold it.
#pragma once

#include <deque>
#include <functional>
#include <vector>

#include "risorius/track/channels.h"

namespace risorius::track {

/// Computes the envelopes of all columns at any time.
class SimulatedEmg {
  public:
    using DriveAt = std::function<Drive(double t_s)>;

    /// `drive` is evaluated up to half a second before and after the requested time. For times before 0, it is evaluated at 0.
    SimulatedEmg(const ChannelTable& channels, DriveAt drive);

    /// Envelope of every column, [0, 1]. With increasing times, each call needs only a few evaluations of the drive.
    Eigen::VectorXd at(double t_s);

  private:
    const Eigen::VectorXd& activity(long sample);
    Eigen::VectorXd envelope(long sample);

    DriveAt drive_;
    Eigen::VectorXd min_;
    std::vector<double> kernel_;            ///< of the filter, symmetric
    std::deque<Eigen::VectorXd> activity_;  ///< e, beginning at sample first_
    long first_ = 0;
};

}  // namespace risorius::track
