// SPDX-License-Identifier: MIT
/// \file
/// The recording of a clip: its offset in the clip, its loudness and its gain.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "risorius/design/conditions.h"
#include "risorius/media/loudness.h"

namespace risorius::stimuli {

/// A recording, and its loudness as a whole.
struct ClipSound {
    std::filesystem::path file;
    std::string name;  ///< of the file, in the sidecar
    std::string sha256;
    /// What removes the file at its end: of speech whose sound is made, such as speech in noise
    std::shared_ptr<void> keeps;
    /// Number of samples from the first frame to the first sample, at the rate of the recording
    std::int64_t offset_samples = 0;
    double gain_db = 0;
    /// From the first frame: the first millisecond above a hundredth (-40 dB) of the peak of the recording
    std::optional<double> onset_s;
    media::Loudness loudness;  ///< after the gain
};

/// Where a recording begins in a clip, and what it is called in messages and in the sidecar.
struct SoundPlace {
    std::int64_t offset_samples = 0;
    double duration_s = 0;  ///< of the clip
    std::string name, place;
};

/// Measures a recording. `lufs`: the target loudness. Throws Error naming the place when the clip contains no part of the recording, or
/// the target cannot be reached.
ClipSound measured_sound(const std::filesystem::path& file, const SoundPlace& where,
                         std::optional<double> lufs);

/// Measures each recording once for all clips that use it.
class SoundPlans {
  public:
    /// Returns the sound of a condition; see measured_sound().
    ClipSound at(const design::Condition& condition, double duration_s, std::optional<double> lufs,
                 const std::string& place);

  private:
    std::map<std::string, ClipSound> known_;
};

/// Returns the recording with its gain, for the sound track of the video.
std::shared_ptr<const media::Recording> sound_of(const ClipSound& sound);
/// Returns the part of the recording that the clip contains, starting at the first frame.
media::Sound heard_of(const ClipSound& sound, double duration_s);

}  // namespace risorius::stimuli
