// SPDX-License-Identifier: MIT
/// \file
/// Reads a mesh by the program risorius-import-mesh, in a process with limits of memory and time.
///
/// The program is searched in these places, in this order:
///   1. the file that the environment variable RISORIUS_IMPORT_MESH names,
///   2. beside the program or library that contains this code, and in the folder above (a build folder),
///   3. `libexec/risorius` beside the folder of that program or library (an installation),
///   4. `libexec/risorius` of the installation to which data_folder() belongs.
#pragma once

#include <filesystem>
#include <functional>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::io::detail {

/// Throws Error when the file is no mesh, when the importer crashes or exceeds its limits, and when the program is not found.
/// Throws Interrupted when `stopped` returns true or when a signal stopped the program. It is asked ten times a second.
geom::PolygonMesh import_mesh(const std::filesystem::path& file,
                              const std::function<bool()>& stopped);

}  // namespace risorius::io::detail
