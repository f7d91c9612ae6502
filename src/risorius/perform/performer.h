// SPDX-License-Identifier: MIT
/// \file
/// From pictures of a camera to values of channels: follows the face, calibrates it, reads the channels, filters them.
///
/// A person is calibrated at rest, and may then show a few expressions with all strength (ranges()): from then on the readout is one
/// that reads 1 of the channels of such an expression, and 0 of all others (detail/corrected_readout.h).
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "risorius/perform/detail/one_euro.h"
#include "risorius/perform/rig_reader.h"

namespace risorius::perform {

/// What one picture says.
struct Performed {
    double score = 0;  ///< of the network, 0..1; 0: no face
    bool calibrating = false;
    HeadAngles head;  ///< from the calibrated rest, degrees
    /// Of all channels that are read reliably and of the head; empty before the calibration and without a face
    std::map<std::string, double> values;
    std::vector<double> raw;  ///< of all channels of the reader, not filtered
};

class Performer {
  public:
    Performer(std::shared_ptr<const Networks> networks, std::shared_ptr<const RigReader> reader);

    /// Takes the face as it is from now on, for kCalibration_s, as the face at rest.
    static constexpr double kCalibration_s = 2;
    void calibrate();
    bool calibrated() const { return !rest_.points.empty(); }

    /// Takes it, for as long, as the expression with this index in ranges(), shown with all strength. Nothing happens before the
    /// face at rest is known.
    void calibrate_range(std::size_t range);
    /// By range: kNone, or what the calibration said. kTooSmall: the person shows less than kLeastShown of what the rig shows, which
    /// is then not used.
    enum class RangeState { kNone, kKnown, kTooSmall };
    const std::vector<RangeState>& ranges_state() const { return range_states_; }
    static constexpr double kLeastShown = 0.3;

    /// Times are of the camera and must increase.
    Performed see(const Image& picture, double t_s);

  private:
    bool follow(const Image& picture);
    void gather(double t_s);
    void gather_range(const Eigen::VectorXd& numbers, double t_s);
    void correct_readout();

    std::shared_ptr<const Networks> networks_;
    std::shared_ptr<const RigReader> reader_;
    std::optional<SeenFace> face_;
    /// numbers_of() the last kLooks pictures, each looked at with another crop
    std::deque<Eigen::VectorXd> last_;
    int look_ = 0;
    SeenFace rest_, sum_;
    int gathered_ = 0;
    bool calibrating_ = false;
    double calibration_began_s_ = 0;
    std::optional<std::size_t> range_;    ///< that is shown now
    Eigen::VectorXd shown_sum_;           ///< of gathered_ pictures
    std::vector<Eigen::VectorXd> shown_;  ///< by range; empty: not known
    std::vector<RangeState> range_states_;
    Eigen::MatrixXd readout_;  ///< W'
    std::map<std::string, OneEuro> filters_;
};

}  // namespace risorius::perform
