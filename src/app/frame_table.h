// The table beside a video: one row per frame, tab-separated, what drove the face and what it did.
//
//   frame, time_s
//   excitation.<column>, activation.<column>    ratio, every column of the rig
//   emg:<column>                                with emg: what electrodes would record, ratio of the greatest
//   jaw_open ... tongue_out                     kinematic channels, in the units of their names
//   jaw_turn_deg, incisor_opening_mm, condyle_slide_mm, incisor_side_mm    where the jaw is, whatever moves it: turn about the
//                     hinge, way of the lower incisors along the opening path, condyles forwards, incisors to the left
//   tooth_force_n     what all teeth press with when muscles move the jaw, else 0
//   lip_aperture_mm   inner upper to inner lower lip, stos - stoi
//   lip_width_mm      corner to corner, ch_l - ch_r
//   lid_aperture_l_mm, lid_aperture_r_mm        ps - pi
//   <landmark>.x_mm .y_mm .z_mm .u_px .v_px     with landmarks: world, and in the picture from its top left corner
#pragma once

#include <functional>
#include <string>

#include "app/landmark_points.h"
#include "sim/face.h"
#include "track/channels.h"

namespace risorius::app {

struct FrameTableOptions {
    bool landmarks = false;
    std::function<Vec2(const Vec3& world)> project;     ///< pixels; needed with landmarks
    std::function<Eigen::VectorXd(double time_s)> emg;  ///< per column; empty: no such columns
};

class FrameTable {
  public:
    FrameTable(const track::ChannelTable& channels, const LandmarkPoints& points,
               FrameTableOptions options);

    void add(int frame, double time_s, const track::Drive& drive, const Eigen::VectorXd& activation,
             const sim::FacePose& pose);
    const std::string& text() const { return text_; }

  private:
    LandmarkPoints points_;
    FrameTableOptions options_;
    std::string text_;
};

}  // namespace risorius::app
