// SPDX-License-Identifier: MIT
/// \file
/// The channels that a script may drive, and their values at one moment. Channels are the muscles of a rig, action units and
/// kinematic channels.
///
/// Muscles are stored as columns: a paired muscle has a left and a right column, an unpaired one has a single column.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::track {

/// A muscle that a script may drive.
struct MuscleChannel {
    std::string id;  ///< name in the rig's muscle table
    bool paired = true;
    double min = 0.0;  ///< -1 for muscles with resting tone that can be reduced (levator palpebrae)
};

/// Channels that place something directly, without muscles. Drive::kinematic has the same order.
enum class Kinematic {
    // Fraction of the rig's range; side > 0 is the subject's left.
    kJawOpen,
    kJawForward,
    kJawSide,
    // deg; yaw > 0 looks to the subject's left, pitch > 0 up.
    kGazeYawLeft,
    kGazeYawRight,
    kGazePitchLeft,
    kGazePitchRight,
    // deg; yaw > 0 turns to the subject's left, pitch > 0 up, roll > 0 tilts to the subject's left shoulder.
    kHeadYaw,
    kHeadPitch,
    kHeadRoll,
    // mm; side > 0 is the subject's left.
    kHeadForward,
    kHeadUp,
    kHeadSide,
    // Pressure in the oral cavity, Pa; > 0 puffs the cheeks.
    kMouthPressure,
    // Fraction of the rig's protrusion range.
    kTongueOut,
    // Curl of the tip, [-1, 1]: > 0 up, < 0 down.
    kTongueUp,
    // Its body, [-1, 1]. Up 1: it touches the palate. Back: where it is highest, 1 at the soft palate.
    kTongueBodyUp,
    kTongueBodyBack,
    kCount
};
inline constexpr int kKinematicCount = static_cast<int>(Kinematic::kCount);
using KinematicValues = std::array<double, kKinematicCount>;

/// Returns whether an action unit moves the channel along a curve of its own: those of the jaw and of the pressure in the mouth.
inline bool has_curve(Kinematic k) {
    return k == Kinematic::kJawOpen || k == Kinematic::kJawForward || k == Kinematic::kJawSide ||
           k == Kinematic::kMouthPressure;
}

/// Name of a kinematic channel in scripts, and its limits in its unit. The limits of gaze and head are norms of adults.
struct KinematicChannel {
    std::string_view name;  ///< with its side, "gaze_yaw_deg.l"
    double min;
    double max;
};

/// Returns the kinematic channels in the order of Kinematic.
const std::array<KinematicChannel, kKinematicCount>& kinematic_channels();

/// Returns the channels that a name in a script means: one channel, or those of both eyes for the name of a gaze channel without
/// a side. Empty when the name is unknown.
std::vector<Kinematic> kinematic_named(std::string_view name);

/// A name split into id and side: "zygomaticus_major.l" is "zygomaticus_major" and left. A name without suffix has no side.
struct SidedName {
    std::string id;
    std::optional<Side> side;
};
SidedName split_side(std::string_view name);

/// The muscles of a rig as columns. The order is that of `muscles`, left before right.
struct ChannelTable {
    std::vector<MuscleChannel> muscles;

    int column_count() const;
    /// Column of a muscle; -1 when unknown. For an unpaired muscle, both sides give its one column.
    int column(const std::string& id, Side side) const;
    /// Null when unknown.
    const MuscleChannel* find(const std::string& id) const;
    /// Lower limit of the excitation of each column.
    Eigen::VectorXd column_min() const;
    /// "zygomaticus_major.l", "zygomaticus_major.r", "orbicularis_oris_upper_marginal", ...
    std::vector<std::string> column_names() const;
};

/// What moves the jaw. kChannels: jaw_open, jaw_forward and jaw_side place it directly. kMuscles: these channels excite the
/// muscles of the jaw.
enum class JawDrive { kChannels, kMuscles };

/// A spring that pulls a point of the skin, as a hand would.
struct Pull {
    int vertex = 0;  ///< of the mesh; the tissue must move it
    /// Where the free end of the spring is, from the position of the vertex at rest, m, world frame.
    Vec3 offset_m = Vec3::Zero();
    double stiffness_n_per_m = 100;  ///< [1, 5000]
};

/// Everything that drives a face at one moment.
struct Drive {
    /// One value per column: the excitation as a fraction of the maximal neural drive, [min, 1], see clamped_drive(). Empty: no
    /// muscle is active.
    Eigen::VectorXd excitation;
    /// One value per column: the activation, [0, 1], where it is set directly; NaN where it follows the excitation. Empty: all
    /// follow.
    Eigen::VectorXd activation;
    KinematicValues kinematic{};
    std::vector<Pull> pulls{};
    double at(Kinematic k) const { return kinematic[static_cast<std::size_t>(k)]; }
};

}  // namespace risorius::track
