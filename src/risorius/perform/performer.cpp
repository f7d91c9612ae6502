// SPDX-License-Identifier: MIT
#include "risorius/perform/performer.h"

#include <algorithm>
#include <cmath>

#include "risorius/perform/detail/corrected_readout.h"

namespace risorius::perform {

namespace {

constexpr double kLost = 0.3;  // score below which the face is searched anew
// Degrees change by tens in a second, values of channels by one.
constexpr OneEuroOptions kOfChannels{1.5, 2, 1}, kOfHead{1.2, 0.05, 1};
constexpr double kMostYaw_deg = 70, kMostPitch_deg = 50, kMostRoll_deg = 40;

bool moves(const Range& range, const std::string& channel) {
    const std::string unit = channel.substr(0, channel.find('.'));
    return std::find(range.units.begin(), range.units.end(), unit) != range.units.end();
}

}  // namespace

Performer::Performer(std::shared_ptr<const Networks> networks,
                     std::shared_ptr<const RigReader> reader)
    : networks_(std::move(networks)),
      reader_(std::move(reader)),
      shown_(ranges().size()),
      range_states_(ranges().size(), RangeState::kNone),
      readout_(reader_->readout) {}

void Performer::calibrate() {
    calibrating_ = true;
    range_.reset();
    gathered_ = 0;
}

void Performer::calibrate_range(std::size_t range) {
    if (!calibrated() || calibrating_ || range >= ranges().size()) return;
    range_ = range;
    gathered_ = 0;
}

/// The face of the next picture is near that of the last one; else the whole picture is searched.
bool Performer::follow(const Image& picture) {
    std::optional<SeenFace> seen;
    if (face_) seen = look_at(networks_->face, picture, crop_of_look(face_->next, look_++));
    if (!seen || seen->score < kLost) {
        seen = find_face(networks_->face, picture);
        last_.clear();
    }
    face_ = std::move(seen);
    if (face_) look_at_eyes(networks_->eye, picture, *face_);
    return face_.has_value();
}

/// Adds the face to the mean of the calibration, upright and in the place of the first one.
void Performer::gather(double t_s) {
    if (gathered_ == 0) {
        sum_ = *face_;
        gathered_ = 1;
        calibration_began_s_ = t_s;
        return;
    }
    const auto mean = [&] {
        SeenFace out = sum_;
        for (Vec3& p : out.points) p /= gathered_;
        for (std::vector<Vec2>& eye : out.eyes)
            for (Vec2& p : eye) p /= gathered_;
        return out;
    };
    const SeenFace before = mean();
    const double unit = eye_distance(before.points);
    const ShapeChange change = change_of(before, *face_);
    for (std::size_t k = 0; k < sum_.points.size(); ++k)
        sum_.points[k] += before.points[k] + unit * change.moved[k];
    for (std::size_t side = 0; side < sum_.eyes.size(); ++side)
        for (std::size_t k = 0; k < sum_.eyes[side].size(); ++k)
            sum_.eyes[side][k] += face_->eyes[side][k];
    ++gathered_;
    if (t_s - calibration_began_s_ < kCalibration_s) return;
    calibrating_ = false;
    rest_ = mean();
    shown_.assign(ranges().size(), {});
    range_states_.assign(ranges().size(), RangeState::kNone);
    readout_ = reader_->readout;
    filters_.clear();
    last_.clear();
}

/// Takes the mean of what is shown while an expression is held.
void Performer::gather_range(const Eigen::VectorXd& numbers, double t_s) {
    if (gathered_ == 0) {
        calibration_began_s_ = t_s;
        shown_sum_ = Eigen::VectorXd::Zero(numbers.size());
    }
    shown_sum_ += numbers;
    ++gathered_;
    if (t_s - calibration_began_s_ < kCalibration_s) return;
    const std::size_t range = *range_;
    range_.reset();
    const Eigen::VectorXd shown = shown_sum_ / gathered_, person = reader_->readout * shown,
                          rig = reader_->full.col(static_cast<Eigen::Index>(range));
    double of_person = 0, of_rig = 0;
    for (std::size_t c = 0; c < reader_->channels.size(); ++c) {
        if (!reader_->channels[c].reliable || !moves(ranges()[range], reader_->channels[c].name))
            continue;
        of_person += person[static_cast<Eigen::Index>(c)];
        of_rig += rig[static_cast<Eigen::Index>(c)];
    }
    const RangeState state =
        of_person > kLeastShown * of_rig ? RangeState::kKnown : RangeState::kTooSmall;
    range_states_[range] = state;
    shown_[range] = state == RangeState::kKnown ? shown : Eigen::VectorXd();
    correct_readout();
}

void Performer::correct_readout() {
    std::vector<Eigen::Index> known;
    for (std::size_t k = 0; k < shown_.size(); ++k)
        if (shown_[k].size() > 0) known.push_back(static_cast<Eigen::Index>(k));
    Eigen::MatrixXd x(readout_.cols(), static_cast<Eigen::Index>(known.size()));
    Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(readout_.rows(), x.cols());
    for (Eigen::Index k = 0; k < x.cols(); ++k) {
        const auto range = static_cast<std::size_t>(known[static_cast<std::size_t>(k)]);
        x.col(k) = shown_[range];
        for (Eigen::Index c = 0; c < wanted.rows(); ++c)
            if (moves(ranges()[range], reader_->channels[static_cast<std::size_t>(c)].name))
                // Two units of one expression hide some of each other, in the rig as well.
                wanted(c, k) = 0.5 * (reader_->curves(c, RigReader::kLevels - 1) +
                                      reader_->full(c, static_cast<Eigen::Index>(range)));
    }
    readout_ = corrected_readout(reader_->readout, x, wanted);
}

Performed Performer::see(const Image& picture, double t_s) {
    Performed out;
    out.calibrating = calibrating_ || range_;
    if (!follow(picture)) return out;
    out.score = face_->score;
    if (calibrating_) gather(t_s);
    if (!calibrated()) {
        out.calibrating = calibrating_;
        return out;
    }
    const ShapeChange change = change_of(rest_, *face_);
    // One look at a picture is not enough; those at the last pictures count as well.
    last_.push_back(numbers_of(change));
    if (last_.size() > kLooks) last_.pop_front();
    Eigen::VectorXd numbers = Eigen::VectorXd::Zero(last_.back().size());
    for (const Eigen::VectorXd& one : last_) numbers += one / static_cast<double>(last_.size());
    if (range_) gather_range(last_.back(), t_s);
    const Eigen::VectorXd read = readout_ * numbers;
    out.calibrating = calibrating_ || range_;
    out.head = change.head;
    const auto filtered = [&](const std::string& name, double value,
                              const OneEuroOptions& options) {
        OneEuro& filter = filters_.try_emplace(name, options).first->second;
        return filter(value, t_s);
    };
    for (std::size_t c = 0; c < reader_->channels.size(); ++c) {
        const CameraChannel& channel = reader_->channels[c];
        out.raw.push_back(reader_->value(c, read[static_cast<Eigen::Index>(c)]));
        if (!channel.reliable) continue;
        out.values[channel.name] =
            std::clamp(filtered(channel.name, out.raw[c], kOfChannels), 0.0, 1.0);
    }
    const auto turn = [&](const char* name, double value_deg, double most_deg) {
        out.values[name] = std::clamp(filtered(name, value_deg, kOfHead), -most_deg, most_deg);
    };
    turn("head_yaw_deg", out.head.yaw_deg, kMostYaw_deg);
    turn("head_pitch_deg", out.head.pitch_deg, kMostPitch_deg);
    turn("head_roll_deg", out.head.roll_deg, kMostRoll_deg);
    return out;
}

}  // namespace risorius::perform
