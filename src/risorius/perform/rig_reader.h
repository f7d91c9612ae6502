// SPDX-License-Identifier: MIT
/// \file
/// Reads values of channels from what the networks see of a face. A reader is learnt on pictures of the rig: the habits of the
/// networks cancel, because they see the rig and the person alike.
///
///   x   numbers_of() a change of the shape      r = W x   what is read      v   value of a channel, 0..1
///
/// W is the ridge regression of the values on x over pictures in which several channels act at once and the head turns:
///   W = argmin sum |W x - v|^2 + n lambda |W|^2
/// Where channels look alike, W reads too little. The curve r_c(v) of each channel, from pictures in which it acts alone, is turned
/// round to tell v from r.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/perform/detail/face_shape.h"
#include "risorius/perform/detail/rig_pictures.h"

namespace risorius::perform {

/// A channel that a camera may see, and how well.
struct CameraChannel {
    std::string name;  ///< "AU12.l"
    /// Root mean square errors on pictures that were left out of the regression in turn: where the channel acts, and where it does not
    double error = 0, false_rms = 0;
    bool reliable = false;  ///< both are below the limits, on both sides of a face
};
inline constexpr double kReliable = 0.25, kReliableElsewhere = 0.15;

/// An expression that a person shows with all strength, so that more or less of it is told apart.
struct Range {
    const char* name;
    std::vector<std::string> units;
};
/// "brows", "smile", "open", "shut"
const std::vector<Range>& ranges();

struct RigReader {
    SeenFace rest;  ///< the rig at rest
    std::vector<CameraChannel> channels;
    Eigen::MatrixXd readout;  ///< W, channels x numbers
    Eigen::MatrixXd curves;   ///< channels x kLevels: r_c(v) at v = 1/kLevels, 2/kLevels ... 1
    Eigen::MatrixXd full;     ///< channels x ranges(): r where the rig shows the range

    static constexpr int kLevels = 8;
    double value(std::size_t channel, double read) const;  ///< v of r
    /// The same of a face as values of all channels.
    std::vector<double> values(const ShapeChange& change) const;
};

/// Learns on `pictures`. Throws Error when no face is seen in them.
RigReader learn_rig(const std::shared_ptr<const scene::RigFiles>& rig, const Networks& networks,
                    const ProgressMonitor& monitor = {});

}  // namespace risorius::perform
