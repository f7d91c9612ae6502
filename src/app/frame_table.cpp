#include "app/frame_table.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace risorius::app {

namespace {

// Micrometres and millionths: enough for any analysis, and short.
std::string cell(double value, int decimals) {
    std::array<char, 48> text;
    std::snprintf(text.data(), text.size(), "\t%.*f", decimals, value);
    return text.data();
}

constexpr const char* kLandmarkParts[] = {"x_mm", "y_mm", "z_mm", "u_px", "v_px"};

}  // namespace

FrameTable::FrameTable(const track::ChannelTable& channels, const LandmarkPoints& points,
                       FrameTableOptions options)
    : points_(points), options_(std::move(options)) {
    text_ = "frame\ttime_s";
    for (const char* kind : {"excitation.", "activation."})
        for (const std::string& column : channels.column_names()) text_ += "\t" + (kind + column);
    if (options_.emg)
        for (const std::string& column : channels.column_names()) text_ += "\temg:" + column;
    for (const track::KinematicChannel& channel : track::kinematic_channels())
        text_ += "\t" + std::string(channel.name);
    text_ += "\tjaw_turn_deg\tincisor_opening_mm\tcondyle_slide_mm\tincisor_side_mm\ttooth_force_n";
    text_ += "\tlip_aperture_mm\tlip_width_mm\tlid_aperture_l_mm\tlid_aperture_r_mm";
    if (options_.landmarks)
        for (const std::string& id : points_.ids())
            for (const char* part : kLandmarkParts) text_ += "\t" + id + "." + part;
    text_ += "\n";
}

void FrameTable::add(int frame, double time_s, const track::Drive& drive,
                     const Eigen::VectorXd& activation, const sim::FacePose& pose) {
    text_ += std::to_string(frame) + cell(time_s, 6);
    // A muscle whose activation is set directly has no excitation of its own.
    for (double value : drive.excitation) text_ += cell(value, 6);
    for (double value : activation) text_ += cell(value, 6);
    if (options_.emg)
        for (double value : options_.emg(time_s)) text_ += cell(value, 6);
    for (double value : drive.kinematic) text_ += cell(value, 6);
    constexpr double kDegrees = 180.0 / 3.14159265358979323846;
    for (double value : {kDegrees * pose.jaw.open_rad, 1e3 * pose.jaw.open_m,
                         1e3 * pose.jaw.forward_m, 1e3 * pose.jaw.side_m, pose.tooth_force_n})
        text_ += cell(value, 4);
    for (const auto& [a, b] : {std::pair{"stos", "stoi"}, std::pair{"ch_l", "ch_r"},
                               std::pair{"ps_l", "pi_l"}, std::pair{"ps_r", "pi_r"}})
        text_ += cell(1e3 * points_.distance(a, b, pose.vertices), 4);
    if (options_.landmarks)
        for (const std::string& id : points_.ids()) {
            const Vec3 world = points_.at(id, pose.vertices);
            const Vec2 pixel = options_.project(world);
            for (int k = 0; k < 3; ++k) text_ += cell(1e3 * world[k], 4);
            for (int k = 0; k < 2; ++k) text_ += cell(pixel[k], 3);
        }
    text_ += "\n";
}

}  // namespace risorius::app
