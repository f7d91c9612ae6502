// SPDX-License-Identifier: MIT
#include "risorius/animate/detail/frame_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace risorius::animate {

namespace {

// A tab and a number with a fixed number of decimals.
std::string cell(double value, int decimals) {
    std::array<char, 48> text;
    std::snprintf(text.data(), text.size(), "\t%.*f", decimals, value);
    return text.data();
}

constexpr double kDegrees = 180.0 / 3.14159265358979323846;
constexpr const char* kLandmarkParts[] = {"x_mm", "y_mm", "z_mm", "u_px", "v_px"};

}  // namespace

FrameTable::FrameTable(const track::ChannelTable& channels, const scene::LandmarkPoints& points,
                       const track::UnitIntensity& units, FrameTableOptions options)
    : points_(points), units_(units), options_(std::move(options)) {
    head_ = "frame\ttime_s";
    for (const char* kind : {"excitation.", "activation."})
        for (const std::string& column : channels.column_names()) head_ += "\t" + (kind + column);
    if (options_.emg)
        for (const std::string& column : channels.column_names()) head_ += "\temg:" + column;
    for (const std::string& unit : units_.names()) head_ += "\t" + unit;
    for (const track::KinematicChannel& channel : track::kinematic_channels())
        head_ += "\t" + std::string(channel.name);
    head_ += "\tjaw_turn_deg\tincisor_opening_mm\tcondyle_slide_mm\tincisor_side_mm\ttooth_force_n";
    head_ += "\tlip_aperture_mm\tlip_width_mm\tlid_aperture_l_mm\tlid_aperture_r_mm";
    head_ += "\teye_yaw_deg.l\teye_pitch_deg.l\teye_yaw_deg.r\teye_pitch_deg.r";
    if (options_.landmarks)
        for (const std::string& id : points_.ids())
            for (const char* part : kLandmarkParts) head_ += "\t" + id + "." + part;
    if (options_.speech) head_ += options_.speech_names;
    head_ += "\tluminance_mean\tluminance_sd\tcontrast_rms\tmotion_energy";
    if (options_.masks) head_ += "\tluminance_face\tluminance_eyes\tluminance_mouth";
    if (options_.photodiode) head_ += "\tphotodiode";
    head_ += "\n";
}

void FrameTable::add(int frame, double time_s, const track::Drive& drive,
                     const Eigen::VectorXd& activation, const face::FacePose& pose) {
    std::string row;
    row += std::to_string(frame) + cell(time_s, 6);
    // A muscle with a prescribed activation has no excitation.
    for (double value : drive.excitation) row += cell(value, 6);
    for (double value : activation) row += cell(value, 6);
    if (options_.emg)
        for (double value : options_.emg(time_s)) row += cell(value, 6);
    for (double value : units_.at(time_s)) row += cell(value, 6);
    for (double value : drive.kinematic) row += cell(value, 6);
    for (double value : {kDegrees * pose.jaw.open_rad, 1e3 * pose.jaw.open_m,
                         1e3 * pose.jaw.forward_m, 1e3 * pose.jaw.side_m, pose.tooth_force_n})
        row += cell(value, 4);
    for (const auto& [a, b] : {std::pair{"stos", "stoi"}, std::pair{"ch_l", "ch_r"},
                               std::pair{"ps_l", "pi_l"}, std::pair{"ps_r", "pi_r"}})
        row += cell(1e3 * points_.distance(a, b, pose.vertices), 4);
    for (std::size_t side = 0; side < 2; ++side) {
        const Vec3 gaze = pose.eye_rotation[side] * options_.eye_forward[side];
        row += cell(kDegrees * std::atan2(gaze.x(), gaze.z()), 4);
        row += cell(kDegrees * std::asin(std::clamp(gaze.y() / gaze.norm(), -1.0, 1.0)), 4);
    }
    if (options_.landmarks)
        for (const std::string& id : points_.ids()) {
            const Vec3 world = points_.at(id, pose.vertices);
            const Vec2 pixel = options_.project(world);
            for (int k = 0; k < 3; ++k) row += cell(1e3 * world[k], 4);
            for (int k = 0; k < 2; ++k) row += cell(pixel[k], 3);
        }
    if (options_.speech) row += options_.speech(time_s, pose);
    rows_.push_back(std::move(row));
}

void FrameTable::add_picture(const media::PictureMeasures& picture,
                             const std::array<double, 3>& within, bool photodiode_lit) {
    std::string cells;
    for (const double value : {picture.luminance_mean, picture.luminance_sd, picture.contrast_rms})
        cells += cell(value, 6);
    cells += cell(picture.motion_energy, 9);
    if (options_.masks)
        for (const double value : within) cells += std::isnan(value) ? "\t" : cell(value, 6);
    if (options_.photodiode) cells += photodiode_lit ? "\t1" : "\t0";
    pictures_.push_back(std::move(cells));
}

std::string FrameTable::text() const {
    std::string text = head_;
    for (std::size_t i = 0; i < rows_.size(); ++i)
        text += rows_[i] + (i < pictures_.size() ? pictures_[i] : "") + "\n";
    return text;
}

}  // namespace risorius::animate
