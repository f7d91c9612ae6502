// SPDX-License-Identifier: MIT
/// \file
/// Where a talking face looks: away while a sentence begins, then from point to point of the listener's face.
///
/// The eyes jump (saccades of 22 ms and 2.3 ms for each degree) and rest for 0.7 to 2 s. They turn away by 6 to 10 degrees from
/// 0.1 s before a sentence to 0.3 s after its first sample, and are ahead again after the last sentence.
///
/// Sources: A. Kendon 1967, Acta Psychol. 26, 22-63 (speakers look away as they begin); A. T. Bahill, M. R. Clark, L. Stark 1975, Math.
/// Biosci. 24, 191-204 (how long saccades last). The sizes are estimates.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/speech/utterance.h"

namespace risorius::speech {

struct GazeShift {
    double start_s, duration_s;  ///< from the first sample of the sound
    double yaw_deg, pitch_deg;   ///< where it ends; above 0 to the subject's left, and up
};

/// `size` scales all angles, [0, 2]; 0: none.
std::vector<GazeShift> gaze_of(const Utterance& utterance, double size, std::uint64_t seed);

/// Yaw and pitch, degrees. Before the first shift the eyes look ahead.
Vec2 gaze_at(const std::vector<GazeShift>& shifts, double t_s);

}  // namespace risorius::speech
