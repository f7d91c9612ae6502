// SPDX-License-Identifier: MIT
/// \file
/// From pictures of a camera to values of channels: follows the face, calibrates it at rest, fits the channels, filters them.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "risorius/perform/channel_columns.h"
#include "risorius/perform/detail/one_euro.h"

namespace risorius::perform {

/// What one picture says.
struct Performed {
    double score = 0;  ///< of the network, 0..1; 0: no face
    bool calibrating = false;
    HeadAngles head;  ///< from the calibrated rest, degrees
    /// Of all channels that the rig shows reliably and of the head; empty before the calibration and without a face
    std::map<std::string, double> values;
    std::vector<double> raw;  ///< of all channels of the columns, not filtered
};

class Performer {
  public:
    Performer(std::shared_ptr<const landmarks::FaceNetwork> network,
              std::shared_ptr<const Columns> columns);

    /// Takes the face as it is from now on, for kCalibration_s, as the face at rest.
    static constexpr double kCalibration_s = 2;
    void calibrate();
    bool calibrated() const { return !rest_.empty(); }

    /// Times are of the camera and must increase.
    Performed see(const Image& picture, double t_s);

  private:
    bool follow(const Image& picture);
    void gather(double t_s);
    ShapeChange mean_change();

    std::shared_ptr<const landmarks::FaceNetwork> network_;
    std::shared_ptr<const Columns> columns_;
    std::optional<SeenFace> face_;
    std::deque<ShapeChange>
        last_;  ///< of the last kLooks pictures, each looked at with another crop
    int look_ = 0;
    std::vector<Vec3> rest_, sum_;
    int gathered_ = 0;
    bool calibrating_ = false;
    double calibration_began_s_ = 0;
    std::map<std::string, OneEuro> filters_;
};

}  // namespace risorius::perform
