// SPDX-License-Identifier: MIT
/// \file
/// How large the files of meshes and their contents may be. A head of film quality has 100,000 vertices, a raw scan some
/// millions.
#pragma once

#include <cstddef>

#include "risorius/core/read_file.h"

namespace risorius::io::detail {

inline constexpr FileKind kMeshFile{"a mesh file", 1000 * kMegabyte};
inline constexpr FileKind kMaterialFile{"a material file", 16 * kMegabyte};

inline constexpr std::size_t kMostVertices = 10'000'000;
inline constexpr std::size_t kMostCorners = 60'000'000;  ///< of all faces together
inline constexpr std::size_t kMostNotes = 20;            ///< of one kind
/// What messages expect of a file beyond these limits
inline constexpr const char* kFewerVertices = "at most 10 million vertices";
inline constexpr const char* kFewerCorners = "at most 60 million corners of faces";

}  // namespace risorius::io::detail
