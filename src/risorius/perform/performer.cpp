// SPDX-License-Identifier: MIT
#include "risorius/perform/performer.h"

#include <algorithm>
#include <cmath>

namespace risorius::perform {

namespace {

constexpr double kLost = 0.3;  // score below which the face is searched anew
// Degrees change by tens in a second, values of channels by one.
constexpr OneEuroOptions kOfChannels{1.5, 2, 1}, kOfHead{1.2, 0.05, 1};
constexpr double kMostYaw_deg = 70, kMostPitch_deg = 50, kMostRoll_deg = 40;

}  // namespace

Performer::Performer(std::shared_ptr<const landmarks::FaceNetwork> network,
                     std::shared_ptr<const Columns> columns)
    : network_(std::move(network)), columns_(std::move(columns)) {}

void Performer::calibrate() {
    calibrating_ = true;
    sum_.clear();
    gathered_ = 0;
}

/// The face of the next picture is near that of the last one; else the whole picture is searched.
bool Performer::follow(const Image& picture) {
    if (face_) {
        SeenFace seen = look_at(*network_, picture, crop_of_look(face_->next, look_++));
        if (seen.score >= kLost) {
            face_ = std::move(seen);
            return true;
        }
    }
    face_ = find_face(*network_, picture);
    last_.clear();
    return face_.has_value();
}

/// Adds the face to the mean of the calibration, upright and in the place of the first one.
void Performer::gather(double t_s) {
    if (sum_.empty()) {
        sum_ = face_->points;
        gathered_ = 1;
        calibration_began_s_ = t_s;
        return;
    }
    std::vector<Vec3> mean;
    for (const Vec3& p : sum_) mean.push_back(p / gathered_);
    const double unit = eye_distance(mean);
    const ShapeChange change = change_of(mean, face_->points);
    for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] += mean[k] + unit * change.moved[k];
    ++gathered_;
    if (t_s - calibration_began_s_ < kCalibration_s) return;
    calibrating_ = false;
    rest_.clear();
    for (const Vec3& p : sum_) rest_.push_back(p / gathered_);
    filters_.clear();
    last_.clear();
}

/// One look at a picture is not enough; those at the last pictures count as well.
ShapeChange Performer::mean_change() {
    last_.push_back(change_of(rest_, face_->points));
    if (last_.size() > kLooks) last_.pop_front();
    const double part = 1.0 / static_cast<double>(last_.size());
    ShapeChange out = last_.back();  // the head is that of now
    for (Vec3& p : out.moved) p.setZero();
    out.left_open = out.right_open = 0;
    for (const ShapeChange& one : last_) {
        for (std::size_t k = 0; k < out.moved.size(); ++k) out.moved[k] += part * one.moved[k];
        out.left_open += part * one.left_open;
        out.right_open += part * one.right_open;
    }
    return out;
}

Performed Performer::see(const Image& picture, double t_s) {
    Performed out;
    out.calibrating = calibrating_;
    if (!follow(picture)) return out;
    out.score = face_->score;
    if (calibrating_) gather(t_s);
    out.calibrating = calibrating_;
    if (!calibrated()) return out;
    const ShapeChange change = mean_change();
    out.head = change.head;
    out.raw = fitted_channels(*columns_, change);
    const auto filtered = [&](const std::string& name, double value,
                              const OneEuroOptions& options) {
        OneEuro& filter = filters_.try_emplace(name, options).first->second;
        return filter(value, t_s);
    };
    for (std::size_t c = 0; c < columns_->channels.size(); ++c) {
        const CameraChannel& channel = columns_->channels[c];
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
