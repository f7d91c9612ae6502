// SPDX-License-Identifier: MIT
/// \file
/// A script as read: the rig, the duration, all channels over time, expressions, blinks and the view. The JSON format is
/// "risorius-script", version 1; field names are its keys. Channels are already resolved against a rig.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/track/channels.h"
#include "risorius/track/detail/curve.h"
#include "risorius/track/detail/idle.h"
#include "risorius/track/drive_source.h"
#include "risorius/track/facs.h"
#include "risorius/track/motion.h"
#include "risorius/track/pull_track.h"

namespace risorius::track {

/// "light" of a view; see render::LightOptions.
struct ScriptLight {
    std::string preset = "studio";
    /// Radiance .hdr of the surroundings, instead of the preset; empty: none.
    std::filesystem::path file;
    double turn_deg = 0;     ///< [-360, 360]
    double exposure_ev = 0;  ///< [-10, 10]
    bool for_card = false;   ///< for a grey card instead of the skin
};

/// The "view" of a script.
struct ScriptView {
    int width_px = 1024;  ///< 16..8192
    int height_px = 1024;
    std::string camera = "front";  ///< a name of render::camera_names()
    std::string show = "skin";     ///< a name of render::show_names()
    bool orthographic = false;     ///< "projection"
    bool hair = true;              ///< false: "hair": "none", no locks on the scalp
    std::optional<double> distance_m, view_angle_deg;  ///< see render::Lens
    double aperture_mm = 0;
    /// Time that the shutter is open, centred at the frame's time; 360 is the whole frame, [0, 360].
    double shutter_deg = 0;
    int antialiasing = 2;  ///< 1..4 samples per pixel and side
    ScriptLight light;
    bool transparent = false;  ///< background "transparent"
    std::array<double, 3> background_rgb{0x80 / 255.0, 0x80 / 255.0, 0x80 / 255.0};  ///< sRGB 0..1
};

/// The part of a script that is known before the rig is read.
struct ScriptHeader {
    std::string rig;  ///< as written
    /// Path of the rig file; a relative `rig` starts at the script's folder
    std::filesystem::path rig_file;
    int fps = 60;           ///< 1..240
    double duration_s = 0;  ///< (0, 3600], at least one frame
    int seed = 1;
    JawDrive jaw = JawDrive::kChannels;  ///< "channels" or "muscles"
    Motion motion = Motion::kDynamic;    ///< "dynamic" or "quasi_static"
    /// "gravity" of the script: true is 9.81 m/s^2 downwards; a vector is used as given; false is no value, and then the face
    /// hangs as when upright, whatever the pose of the head.
    std::optional<Vec3> gravity_m_s2{Vec3(0, -9.81, 0)};
    ScriptView view;

    int frame_count() const;
};

/// Returns the number of frames of a video, of which frame n shows the time n / fps.
int frame_count(double duration_s, int fps);

/// The course of one channel over time.
struct ChannelTrack {
    std::string name;  ///< "AU6.l"
    std::vector<Key> keys;
    Interpolation interpolation = Interpolation::kSmooth;
    bool activation = false;  ///< sets activation directly, bypassing activation dynamics
    Expansion drives;         ///< contribution of the channel at value 1
    UnitCurves curve{};       ///< of an action unit or an ARKit shape
};

/// An expression rises along a minimum-jerk curve, is held and falls again. Every unit has its own delay within the onset.
struct ExpressionEvent {
    struct Part {
        Expansion drives;  ///< at full intensity
        UnitCurves curve;
        double intensity = 1;  ///< at the apex
        double delay = 0;      ///< fraction of the onset
        UnitUse
            use;  ///< the part as a unit, with its value in the event; its name is empty for a muscle
    };
    std::string expression, variant;  ///< variant: empty for the usual form
    std::optional<Side> side;         ///< none: as in the table
    double intensity = 1;             ///< [0, 1]
    /// Maximum of a random reduction of the intensity on one side, [0, 0.5]. That side also starts up to 40 ms late
    double asymmetry = 0;
    double start_s = 0, onset_s = 0, hold_s = 0, offset_s = 0;
    std::vector<Part> parts;
};

/// A blink; see timeline.h for its course.
struct BlinkEvent {
    double start_s = 0;
    double duration_s = 0.22;  ///< from the start of the drive until the lids are open again
    double intensity = 1;      ///< below about 0.8 the lids do not close
    std::optional<Side> side;
    Expansion drives;  ///< of AU45 at this intensity
};

/// The excitation of a muscle from a recorded electromyogram. Its range is [min of the muscle, 1].
struct EmgTrack {
    std::string muscle;  ///< "zygomaticus_major.l"
    SampledCurve excitation;
    Expansion drives;  ///< contribution of a value of 1
};

/// A whole script, resolved against a rig.
struct ScriptDescription {
    ScriptHeader header;
    std::vector<ChannelTrack> channels;
    std::vector<EmgTrack> emg;
    std::vector<ExpressionEvent> expressions;
    std::vector<BlinkEvent> blinks;  ///< includes those of idle events
    std::vector<IdleEvent> idle;
    /// One value per column: the fraction of a muscle's strength that is missing, [0, 1]. Empty: no muscle is weak.
    Eigen::VectorXd weakness;
    /// Events "say" as written; module talk makes sources of them.
    std::vector<JsonCursor> says;
    std::vector<std::shared_ptr<const DriveSource>> sources;
    std::vector<PullTrack> pulls;
    std::array<double, 2> late_s{0, 0};  ///< delay of all muscles of a side, [0, 10]
    /// Files that were read besides the script itself.
    std::vector<std::filesystem::path> recordings;
    std::vector<std::string> notes;  ///< about recordings: what was bridged, what is never played
};

/// Reads only the header, without channels and events. Throws Error.
ScriptHeader read_script_header(const std::filesystem::path& file);
ScriptHeader read_script_header(const JsonCursor& script);

/// Reads everything and checks it against the rig. Throws Error that names the file, the place, and the expected and the found
/// value.
ScriptDescription read_script(const std::filesystem::path& file, const ChannelTable& channels,
                              const FacsTable& facs, const Expressions& expressions);

/// Does the same for a script that is in memory.
ScriptDescription read_script(const JsonCursor& script, const ChannelTable& channels,
                              const FacsTable& facs, const Expressions& expressions);

}  // namespace risorius::track
