// SPDX-License-Identifier: MIT
/// \file
/// The program `risorius import`: recorded motion becomes a script. Recorded motion is what was seen, so the script sets the
/// activation of muscles directly, without the delay of muscles.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/motion/detail/recorded_motion.h"
#include "risorius/track/motion.h"

namespace risorius::motion {

/// Options of import_motion().
struct ImportOptions {
    std::filesystem::path file = {}, out = {};  ///< out: the script to write
    std::filesystem::path rig = {};             ///< the rig that the script names
    ReadMotionOptions read = {};
    bool mirror =
        false;  ///< exchanges left and right: for mirrored pictures, as selfie cameras make
    /// Angles whose sign is turned: "yaw", "pitch", "roll", of head and eyes
    std::vector<std::string> invert = {};
    /// Begin and end of a time in which the face is neutral, s: the median of each channel there becomes 0
    std::optional<std::array<double, 2>> neutral_s = {};
    /// Low-pass frequency without delay, Hz; lids have at least 15 Hz, and the eyes are never smoothed. 0: none
    double smooth_hz = 0;
    /// Largest error of a weight by leaving keys out; of an angle, ten times as many degrees
    double tolerance = 0.01;
    /// "motion" of the script. Dynamic tissue answers late: on the adult rig lips by up to 17 ms, brows by up to 50 ms.
    track::Motion motion = track::Motion::kQuasiStatic;
};

/// Longest time without a face for which its last values are held, and the time of fading to rest after it, s.
inline constexpr double kHold_s = 0.2, kFade_s = 0.3;

/// A channel of the script.
struct ImportedChannel {
    std::string name;
    double min = 0, max = 0;
    int keys = 0;
};

/// The result of import_motion().
struct ImportReport {
    std::string file, script, format;
    double fps = 0, duration_s = 0;
    int samples = 0;  ///< of the file
    int lost = 0;     ///< frames that are not in the file
    int unseen = 0;   ///< samples without a face
    int faded = 0;    ///< of them, those after the time of holding
    std::vector<ImportedChannel> channels;
    int still = 0;                      ///< channels that stay at rest, and are left out
    std::vector<std::string> unmapped;  ///< names in the file without a channel of the rig
    std::vector<std::string> notes;

    long values() const;  ///< samples of all channels
    long keys() const;
    Json json() const;
};

/// Changes a recording as the options say, and bridges the times without a face. Throws Error.
void prepare_motion(RecordedMotion& motion, const ImportOptions& options, ImportReport& report);

/// Reads, converts and writes. Throws Error.
ImportReport import_motion(const ImportOptions& options);

}  // namespace risorius::motion
