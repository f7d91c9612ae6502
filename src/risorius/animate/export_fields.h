// SPDX-License-Identifier: MIT
/// \file
/// Plays a script and writes the fields of every frame as files of VTK, for ParaView:
///
///   DIR/tissue_0000.vtu    tetrahedra: displacement, contact pressure; J, Cauchy stress, von Mises stress
///   DIR/fibres_0000.vtu    segments of the bundles of fibres: direction, stretch, tension, activation
///   DIR/solids_0000.vtu    cells of the volume muscles: all of the above; only if the rig has volume muscles
///   DIR/skin_0000.vtp      the skin as it is seen: displacement
///   DIR/tissue.pvd ...     the series over time; DIR/face.pvd has all of them
///   DIR/results.json       what was run, and the list of all files
///
/// Or its muscles for OpenSim:
///
///   DIR/face.osim          the muscles at rest as paths with their parameters, mandible and hyoid
///   DIR/activation.sto     the activation of each of these muscles over time
///   DIR/results.json
///
/// Positions are in the world frame, m. The reference of displacement is the face at rest.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::animate {

struct ExportOptions {
    std::filesystem::path script;
    std::optional<std::filesystem::path> rig;  ///< instead of that of the script
    std::filesystem::path out;          ///< a folder that is new, empty or has former results
    std::string format = "vtu";         ///< "vtu", "osim"
    std::string encoding = "appended";  ///< "appended" (binary) or "ascii"
    std::optional<int> fps;             ///< of the frames; else that of the script
    std::vector<double> times_s;        ///< only these times, ascending; empty: every frame
    std::string quality = "video";      ///< a name of face::quality_named()
};

/// Returns the content of results.json. Throws Error, RunError and Interrupted; then nothing is written.
Json export_fields(const ExportOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::animate
