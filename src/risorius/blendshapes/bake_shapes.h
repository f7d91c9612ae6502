// SPDX-License-Identifier: MIT
/// \file
/// The program `risorius shapes`. It makes blend shapes from a rig, measures their quality (shape_certificate.h), and writes them
/// in the file formats that other programs read.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/blendshapes/detail/make_shapes.h"
#include "risorius/blendshapes/detail/shape_animation.h"
#include "risorius/blendshapes/detail/shape_correctives.h"
#include "risorius/blendshapes/detail/shape_maps.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/io/level_error.h"

namespace risorius::blendshapes {

inline constexpr int kMaxLevels = 4;

/// Options of bake_shapes().
struct ShapesOptions {
    std::filesystem::path rig = {}, out = {};  ///< the rig file, and the folder to write
    std::string set = "arkit52";
    std::vector<std::string> only = {};     ///< names of shapes; empty: the whole set
    std::string quality = "preview";        ///< face::quality_named(): the mesh of the simulation
    std::vector<std::string> formats = {};  ///< names of shape_formats(); empty: all but "cache"
    /// True: the .glb holds displacements as 16-bit integers, with a scale of its node, instead of floats in metres
    bool compact = false;
    /// Side of the picture of the skin in the .glb, 256 to 4096; those of the other parts have half of it. 0: plain colours.
    /// Parts with pictures of the mesh keep those.
    int texture_px = 1024;
    std::string eyes =
        "both";  ///< what turns the eyeballs in the .glb: "morph", "bone" or "both", see morph_head.h
    std::string hair = "own";  ///< of the .glb and .usda: "own", the locks of the rig, or "none"
    /// Number of coarser levels of detail to write, 0 to kMaxLevels; each has half the triangles of the one before
    int levels = 0;
    bool pictures = true;
    bool correctives = true;
    bool named_correctives = false;  ///< CorrectiveOptions::named
    /// Values that replace those of correctives_of_set().
    std::optional<int> pairs = {};
    std::optional<double> corrective_tolerance_m = {};
    std::optional<long> corrective_bytes = {};
    /// Frames of each track on which the blend shapes are compared with the simulation; 0: none
    int test_frames = 24;
    std::filesystem::path script = {};  ///< script that is converted to weights; empty: none
    bool head_turns = false;            ///< true: caches have the motion of head and eyes too
    int maps_px = 0;  ///< side of the maps of each shape (shape_maps.h), 256 to 4096; 0: none
    int threads = 0;  ///< 0: as many as the machine has; results do not depend on it
};

/// The names of the formats: "glb", "obj", "table", "usda", and for a script also "csv", "cache", "pc2" and "mdd".
const std::vector<std::string>& shape_formats();

/// What was made, and how well it agrees with the simulation.
struct ShapesReport {
    std::string name;  ///< name of the rig
    std::string rig, set, quality;
    track::ChannelTable channels;
    MadeShapes shapes;
    Correctives correctives;                  ///< the shapes and their correctives
    std::vector<TrackError> tracks;           ///< errors of the blend shapes against the simulation
    std::optional<ShapeAnimation> animation;  ///< the script converted to weights
    std::vector<std::pair<std::string, std::string>> left_out;  ///< name and reason
    /// Coarser levels of detail: file, and its error against shapes.glb
    std::vector<std::pair<std::string, io::LevelError>> levels;
    std::optional<MapsReport> maps;
    int vertices = 0, nodes = 0;
    double solving_s = 0;                             ///< wall time
    std::vector<std::pair<std::string, long>> sizes;  ///< file, bytes

    /// Returns the number of shapes with a measured value beyond its limit.
    int complaints() const;
    /// Returns the report without times, so that the same rig gives the same bytes.
    Json json() const;
};

/// Makes the shapes and writes their files. Throws Error when the rig cannot be used and Interrupted when the monitor asks to
/// stop; then no files are left.
ShapesReport bake_shapes(const ShapesOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::blendshapes
