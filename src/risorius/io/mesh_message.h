// SPDX-License-Identifier: MIT
/// \file
/// The message with which the program risorius-import-mesh hands over a mesh. It reads files with a library that may crash or
/// never return, therefore it is a process of its own, and its message is not trusted: every count, index and length is checked.
///
/// Numbers have the byte order and the sizes of this machine, since both processes run on it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::io {

inline constexpr const char* kImportProgram = "risorius-import-mesh";
inline constexpr int kOutOfMemory = 77;  ///< exit code of the program

/// What the program may take for a file of this size.
struct ImportLimits {
    std::size_t memory_bytes;
    int processor_s;
};
ImportLimits import_limits(std::size_t file_bytes);

/// The parts of an Error.
struct MeshProblem {
    std::string place, expected, found;
};

/// Takes `size` bytes at `data`.
using ByteSink = std::function<void(const void* data, std::size_t size)>;
/// Gives exactly `size` bytes, or returns false.
using ByteSource = std::function<bool(void* data, std::size_t size)>;

void write_mesh_message(const geom::PolygonMesh& mesh, const ByteSink& out);
void write_mesh_message(const MeshProblem& problem, const ByteSink& out);

/// Reads a message. The result is empty when the source ends early or the message is not sound. `problem` receives what the
/// program says in place of a mesh; the mesh is then empty.
std::optional<geom::PolygonMesh> read_mesh_message(const ByteSource& in, MeshProblem& problem);

}  // namespace risorius::io
