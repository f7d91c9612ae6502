// The recording of a clip: where it is heard, how loud it is, and how much louder it is made.
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

/// Of what is heard within the clip.
struct ClipSound {
    std::filesystem::path file;
    std::string sha256;
    std::int64_t offset_samples = 0;  ///< from the first frame to the first sample, of its own rate
    double gain_db = 0;
    media::Loudness loudness;  ///< with the gain
};

/// Recordings are measured once for many clips with them.
class SoundPlans {
  public:
    /// `lufs`: what the loudness shall be. Throws Error naming `place` when nothing is heard, or the loudness cannot be had.
    ClipSound at(const design::Condition& condition, double duration_s, std::optional<double> lufs,
                 const std::string& place);

  private:
    std::map<std::string, ClipSound> known_;
};

/// To be put beside the pictures.
std::shared_ptr<const media::Sound> sound_of(const ClipSound& sound);
/// What is heard while the clip lasts, from its first frame on.
media::Sound heard_of(const ClipSound& sound, double duration_s);

}  // namespace risorius::stimuli
