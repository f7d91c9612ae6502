// SPDX-License-Identifier: MIT
/// \file
/// A pose as bytes for the page: 76 bytes of header, then whole numbers. All numbers are little-endian.
///
/// | bytes | type | content |
/// |---|---|---|
/// | 0 | uint8 | 1, the kind of the message |
/// | 1 | uint8 | flags: 1 strain follows, 2 muscles follow |
/// | 2 | uint16 | C, columns of the rig's muscles |
/// | 4 | uint32 | step of the session |
/// | 8 | float64 | time in the script, s |
/// | 16 | 7 float32 | motion of the head: quaternion x, y, z, w, then translation, m |
/// | 44 | 7 float32 | motion of the mandible in the head |
/// | 72 | uint32 | V, vertices |
/// | 76 | 3 V int16 | positions, world frame, in units of PoseUnit::unit_m |
/// | | C int8, C int8 | drive and activation, in units of 1/127 |
/// | | V int8 | strain, in units of 0.4 / 127, if the flag is set; -128: none |
/// | | uint32, 3 M int16 | M and the vertices of the muscles, if the flag is set |
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::view {

inline constexpr double kFinestUnit_m = 1e-5;  ///< an error of at most 0.005 mm
inline constexpr double kStrainScale = 0.4;    ///< as render::Show::kStrain

/// What a pose frame holds.
struct PoseFrame {
    std::uint32_t step = 0;
    double t_s = 0;
    Rigid head = Rigid::Identity(), mandible = Rigid::Identity();
    Points vertices;                    ///< V x 3, m
    Eigen::VectorXd drive, activation;  ///< per column, [-1, 1]
    std::vector<double> strain;         ///< V or none; NaN: no value
    Points muscles;                     ///< M x 3, m, or no rows
};

/// The length of one unit of positions: the finest, or a coarser one for a mesh that does not fit into 16 bits otherwise.
double unit_for(const Points& rest);

std::string encode_pose(const PoseFrame& pose, double unit_m);
/// Reads what encode_pose() wrote. Throws std::invalid_argument for other bytes.
PoseFrame decode_pose(const std::string& bytes, double unit_m);

}  // namespace risorius::view
