// SPDX-License-Identifier: MIT
/// \file
/// Motion of a face as a tracker recorded it, in the terms of a script: weights of ARKit shapes, intensities of action units,
/// activations of muscles, and angles of head and eyes in degrees.
///
/// Angles are those of scripts: yaw > 0 to the subject's left, pitch > 0 up, roll > 0 to the subject's left shoulder. In a frame
/// with x to the subject's left, y up and z out of the face, the head is turned by Ry(yaw) Rx(-pitch) Rz(-roll).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace risorius::motion {

/// The values of one channel, one per sample.
struct RecordedTrack {
    std::string
        channel;  ///< as scripts name it: "mouthSmileLeft", "AU12", "head_yaw_deg", "gaze_yaw_deg.l"
    std::vector<double> values;
    bool is_angle() const { return channel.find("_deg") != std::string::npos; }
};

/// A recording.
struct RecordedMotion {
    std::string format;           ///< a name of motion_formats()
    double fps = 0;               ///< nominal rate, 1/s
    std::vector<double> times_s;  ///< rising; the first is 0
    std::vector<char>
        seen;  ///< whether the tracker saw the face; the values of other samples mean nothing
    std::vector<RecordedTrack> tracks;
    int lost = 0;        ///< frames that the times skip
    bool keyed = false;  ///< samples are keys of an animation; between them values are linear
    std::vector<std::string> unmapped;  ///< names in the file that have no channel
    std::vector<std::string> notes;     ///< what was changed or assumed while reading

    const RecordedTrack* find(const std::string& channel) const;  ///< null when there is none
};

/// Options of read_motion().
struct ReadMotionOptions {
    std::string as = {};  ///< a name of motion_formats(); empty: found from the content
    double fps =
        0;  ///< rate of files that do not say it; 0: that of the file, or the usual one of the format
};

/// Returns the formats that are read: "livelink", "mediapipe", "openface", "pyfeat", "arkit", "gltf", "vmc", "bvh", "storage".
const std::vector<std::string>& motion_formats();

/// Reads a recording. Throws Error for a file of no known format, and for one that breaks its format.
RecordedMotion read_motion(const std::filesystem::path& file,
                           const ReadMotionOptions& options = {});

}  // namespace risorius::motion
