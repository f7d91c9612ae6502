// SPDX-License-Identifier: MIT
/// \file
/// Reads landmarks over time as programs record them:
///
///   a table with the landmarks of a rig       time_s, prn.x_mm, prn.y_mm, prn.z_mm, ...            mm, in the axes of the rig's head
///   a table with points of a set              time_s, mediapipe_33.x, mediapipe_33.y, mediapipe_33.z, ..., face68_36.x, ...
///   the table of OpenFace 2                   timestamp, confidence, success, X_0 ... Z_67, else x_0 ... y_67
///   JSON of MediaPipe FaceLandmarker          timestampMs, faceLandmarks: one result a line, or a list
///
/// Tables may have columns ID.confidence, and confidence for all, 0 to 1. Points of sets may have any unit and any axes, as long as they
/// are not mirrored; those without a depth are flat.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::inverse {

struct LandmarkRecording {
    std::string set;                 ///< "rig", "mediapipe" or "face68"
    std::vector<double> times_s;     ///< rising
    std::vector<std::string> ids;    ///< landmarks of the rig, those that the file has
    std::vector<Points> at;          ///< one per frame, a row per landmark
    Eigen::MatrixXd confidence;      ///< landmarks x frames, 0 to 1; 0: it was not seen
    bool flat = false;               ///< z is 0
    std::vector<std::string> notes;  ///< values that were missing and are bridged
    bool of_rig() const { return set == "rig"; }
};

/// `ids`: the landmarks of the rig. `picture_px`: width and height of the picture, which the coordinates of MediaPipe are shares of; 0: not
/// known. Throws Error for a file without landmarks, with broken numbers, and for MediaPipe's JSON without a size of the picture.
LandmarkRecording read_landmark_recording(const std::filesystem::path& file,
                                          const std::vector<std::string>& ids,
                                          const std::array<int, 2>& picture_px);

}  // namespace risorius::inverse
