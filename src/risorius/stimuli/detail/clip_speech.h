// SPDX-License-Identifier: MIT
/// \file
/// Speech in a clip: the sound of what is said, and when the mouth and the sound do what.
///
///   lip_onset_s      gap or opening of the lips have changed by 5 % of their range; between frames
///   closure_s        the first stop or nasal that is seen is closed, as the face is told
///   release_s        it is released
///   burst_s          the first stop or nasal that is heard is released in the sound
///   soa_ms           burst_s - release_s: > 0: the sound is late
///
/// All of them count from the first frame.
#pragma once

#include <optional>

#include "risorius/animate/frame_rows.h"
#include "risorius/animate/render_job.h"
#include "risorius/stimuli/detail/clip.h"

namespace risorius::stimuli {

/// Returns the sound of what the script of a clip says; none when it says nothing, or without a sound. `inputs`: those that simulate no
/// mouths will do.
std::optional<ClipSound> spoken_sound(const ClipPlan& plan, animate::RenderInputs& inputs,
                                      std::optional<double> lufs);

/// Returns the moments for the sidecar; null when nothing is said. `rows`: the frames in the order of the script.
Json speech_moments(const animate::RenderJob& job, const animate::FrameRows& rows);

}  // namespace risorius::stimuli
