// SPDX-License-Identifier: MIT
/// \file
/// The table beside a video, tab-separated: one row for each frame, with the drive of the face and its motion.
///
///   frame, time_s
///   excitation.<column>, activation.<column>    ratio, every column of the rig
///   emg:<column>                                with emg: simulated surface EMG, ratio of the maximum
///   AU1.l ... AU66                              intensity of each action unit in the script, ratio; track/unit_intensity.h
///   jaw_open ... tongue_body_back               kinematic channels, in the units of their names
///   jaw_turn_deg, incisor_opening_mm, condyle_slide_mm, incisor_side_mm    pose of the jaw, from channels or muscles: rotation about the
///                     hinge, lower incisors along the opening path, condyles forwards, lower incisors to the left
///   tooth_force_n     force on all teeth when muscles move the jaw, else 0
///   lip_aperture_mm   inner upper to inner lower lip, stos - stoi
///   lip_width_mm      corner to corner, ch_l - ch_r
///   lid_aperture_l_mm, lid_aperture_r_mm        ps - pi
///   eye_yaw_deg.l .r, eye_pitch_deg.l .r        direction of gaze in the world, with the turn of the head: left and up > 0
///   <landmark>.x_mm .y_mm .z_mm .u_px .v_px     with landmarks: world, and in the picture from its top left corner
///   phone, word, viseme, lip_gap_mm, ...        with speech: talk/speech_columns.h
///   luminance_mean, luminance_sd, contrast_rms, motion_energy       of the picture without its marks; media/luminance.h
///   luminance_face .eyes .mouth                 with masks: mean luminance within each mask; empty when it is not visible
///   photodiode        1 where its square is white, with a photodiode
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "risorius/face/face.h"
#include "risorius/media/luminance.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/track/channels.h"
#include "risorius/track/unit_intensity.h"

namespace risorius::animate {

struct FrameTableOptions {
    bool landmarks = false;
    /// Position in the picture, px; needed when the table has landmarks
    std::function<Vec2(const Vec3& world)> project;
    std::function<Eigen::VectorXd(double time_s)> emg;  ///< for each column; empty: no such columns
    std::array<Vec3, 2> eye_forward{Vec3::UnitZ(), Vec3::UnitZ()};  ///< direction of gaze at rest
    std::string speech_names{};  ///< with speech: its columns, each after a tab
    /// With speech: their cells
    std::function<std::string(double time_s, const face::FacePose& pose)> speech{};
    bool masks = false;  ///< adds mean luminance within each mask
    bool photodiode = false;
};

/// Collects the rows of the table.
class FrameTable {
  public:
    FrameTable(const track::ChannelTable& channels, const scene::LandmarkPoints& points,
               const track::UnitIntensity& units, FrameTableOptions options);

    /// Adds the row of a frame, without its picture.
    void add(int frame, double time_s, const track::Drive& drive, const Eigen::VectorXd& activation,
             const face::FacePose& pose);
    /// Adds the measures of the picture of the next frame; frames come in order. It may be called on another thread than add().
    /// `within`: mean luminance in the masks of face, eyes and mouth; used when there are masks.
    void add_picture(const media::PictureMeasures& picture, const std::array<double, 3>& within,
                     bool photodiode_lit);
    std::string text() const;

  private:
    scene::LandmarkPoints points_;
    track::UnitIntensity units_;
    FrameTableOptions options_;
    std::string head_;
    std::vector<std::string> rows_, pictures_;
};

}  // namespace risorius::animate
