// SPDX-License-Identifier: MIT
/// \file
/// One reader for each format of recorded motion. Sources: the files and manuals of the programs that write them (Live Link Face,
/// MediaPipe FaceLandmarker, OpenFace 2, py-feat, VMC protocol), Biovision BVH, OpenSim storage, glTF 2.0, VRMC_vrm_animation 1.0.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/core/read_file.h"
#include "risorius/core/types.h"
#include "risorius/motion/detail/recorded_motion.h"

namespace risorius::motion::detail {

inline constexpr FileKind kMotionFile{"recorded motion", 1000 * kMegabyte};
inline constexpr double kDegree = 180.0 / 3.14159265358979323846;  ///< deg per rad

RecordedMotion read_live_link(const std::filesystem::path& file, double fps);
RecordedMotion read_mediapipe(const std::filesystem::path& file);
RecordedMotion read_openface(const std::filesystem::path& file);
RecordedMotion read_pyfeat(const std::filesystem::path& file, double fps);
RecordedMotion read_arkit_json(const std::filesystem::path& file);
RecordedMotion read_gltf_motion(const std::filesystem::path& file, double fps);
RecordedMotion read_vmc(const std::filesystem::path& file);
RecordedMotion read_bvh(const std::filesystem::path& file);
RecordedMotion read_storage(const std::filesystem::path& file, double fps);

/// The spelling of ARKit for a name of any case and with or without "_", " " or "." in it; empty for others.
std::string arkit_spelling(std::string_view name);

/// Small letters for the capitals A to Z.
std::string lower_case(std::string_view text);

/// Yaw, pitch and roll of a head that is turned by `turn`, deg.
std::array<double, 3> head_angles(const Mat3& turn);

/// Collects samples whose channels may come and go. A channel that a sample does not name has its value for "nothing there": 0.
class MotionBuilder {
  public:
    /// Begins the next sample.
    void begin(double time_s, bool seen);
    void set(const std::string& channel, double value);
    /// Sets the angles of the head.
    void set_head(const std::array<double, 3>& yaw_pitch_roll_deg);
    /// Notes a name that has no channel, once.
    void unmapped(const std::string& name);
    std::size_t size() const { return out_.times_s.size(); }
    RecordedMotion& motion() { return out_; }
    /// Moves the times to 0, sorts nothing, and counts what the times skip. Throws Error at `place` without samples, and for
    /// times that do not rise.
    RecordedMotion finish(const std::string& place, const std::string& format, double fps);

  private:
    RecordedMotion out_;
    std::set<std::string> unmapped_;  ///< those of out_
};

/// Leaves out eyeLook shapes where the angles of the eyes are recorded, and limits mouthClose to jawOpen, on which it counts.
void settle_shapes(RecordedMotion& motion);

}  // namespace risorius::motion::detail
