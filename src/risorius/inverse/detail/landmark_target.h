// SPDX-License-Identifier: MIT
/// \file
/// Landmarks over time as the target of an inverse solve: the motion of the head is taken off, and the face of a sitter becomes that of
/// the rig.
///
///   sitter    the mean of the frames in a time in which the face is neutral
///   head      the motion that brings each frame nearest to the sitter: of landmarks of the rig, rigid, by those that muscles move by
///             less than 1 mm; of points of a set, with a scale, by all of them, each with the weight c / (m^2 + (1 mm)^2), and again
///             with the distance that is left for m where that is less
///   size      the turn and scale that bring the sitter nearest to the rig at rest, of points of a set: of a face with another size,
///             displacements change in proportion
///
///   c   confidence      m   how far muscles move the landmark
#pragma once

#include <array>
#include <optional>

#include "risorius/inverse/detail/fit_target.h"

namespace risorius::inverse {

struct LandmarkOptions {
    int fps = 30;  ///< rows that are used per second, at most
    std::optional<std::array<double, 2>> neutral_s = {};  ///< begin and end; none: the first row
    std::array<int, 2> picture_px = {};                   ///< see read_landmark_recording()
};

/// Reads landmarks (landmark_recording.h). `max_m`: returns the largest displacement of each of `points` by muscles, m; it is called after the
/// file was read, because it may take minutes. `rest`: vertices of the head. Throws Error.
FitTarget given_landmarks(const std::filesystem::path& file, const LandmarkOptions& options,
                          const scene::LandmarkPoints& points,
                          const std::function<std::vector<double>()>& max_m, const Points& rest);

}  // namespace risorius::inverse
