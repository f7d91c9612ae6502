// SPDX-License-Identifier: MIT
/// \file
/// What the muscles of one rig do to its mouth: poses that were simulated once, with their activations and measures. A wanted
/// mouth is a mixture of them. Format "risorius-voice", version 1.
///
/// For a wanted mouth y the weights w of the poses minimise
///
///   |S (sum w_i y_i - y)|^2 + effort (sum w_i |a_i|_1)^2 + far sum w_i |y_i - y|^2 + ridge |w|^2,   w >= 0, sum w = 1
///
///   y_i   measures of pose i: gap, width, protrusion of both lips, lower lip to incisors
///   a_i   activations of pose i; the mixture is sum w_i a_i
///   S     weights of the measures
///   far   small: prefers poses near to the wanted mouth, between which activations and measures are nearly linear
///
/// The jaw is placed by its own channel. A pose counts as if its gap were measured at the wanted jaw: y_i + 0.9 (jaw - jaw_i).
/// How hard a closed mouth presses is not in its gap. So the jaw is lowered under the same muscles until the lips part, and the
/// gap of such a pose counts as negative by 0.9 times that way.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/face/face.h"
#include "risorius/talk/detail/mouth_measures.h"

namespace risorius::talk {

/// What the jaw adds to the gap between the lips, mm per mm at the incisors.
inline constexpr double kGapOfJaw = 0.9;

/// A mouth as it is wanted, mm.
struct WantedMouth {
    double jaw = 0, gap = 0, width = 0, protrusion = 0;
    double labiodental = 0;  ///< [0, 1]: the lower lip touches the upper incisors
    double bounded = 0;      ///< 1: a closure, whose gap counts more than all else
};

struct MouthPose {
    Eigen::VectorXd activation;  ///< per column
    double jaw_open = 0;         ///< channel jaw_open
    Mouth mouth;
    double virtual_gap = 0;  ///< mm; below 0: pressed lips
};

class RigVoice {
  public:
    /// Opening of the jaw, mm, at jaw_open = 0, 0.05, 0.1, ...
    RigVoice(std::vector<MouthPose> poses, std::vector<double> jaw_travel_mm,
             std::vector<std::string> columns);

    const std::vector<MouthPose>& poses() const { return poses_; }
    /// The channel jaw_open for an opening, mm.
    double jaw_open_of(double jaw_mm) const;

    /// The activations for a wanted mouth. `state` keeps the search warm from call to call; it does not change the result beyond
    /// rounding.
    Eigen::VectorXd activation_for(const WantedMouth& wanted, Eigen::VectorXd& state) const;

    Json json(const std::string& hash) const;
    /// Reads a file; throws Error. The file must be of a rig with these columns.
    static RigVoice read(const JsonCursor& json, const std::vector<std::string>& columns);

  private:
    std::vector<MouthPose> poses_;
    std::vector<double> jaw_travel_mm_;
    std::vector<std::string> columns_;
    Eigen::MatrixXd activations_;  ///< columns x poses
    Eigen::VectorXd effort_;       ///< of each pose
};

/// Spacing of jaw_open in the table of the jaw's travel.
inline constexpr double kJawStep = 0.05;

/// Simulates the poses of a rig in equilibrium: its visemes, closed, labiodental and pursed mouths, random ones around the visemes,
/// and four rounds of mixtures for the targets of the phones. Takes a few minutes. `report`: called with the fraction that is done.
RigVoice fit_voice(face::Face& face, const rig::RigDescription& rig,
                   const std::function<void(double fraction)>& report);

}  // namespace risorius::talk
