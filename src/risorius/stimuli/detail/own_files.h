// SPDX-License-Identifier: MIT
/// \file
/// Which files in the folder of a set `batch` has written, for this or an earlier design. Only these are ever removed. A file is
/// its own when
/// - a sidecar stimuli/stim-NAME_*.json names it with its SHA-256, and it is one of the files that a clip of that name has,
/// - the record of an unmatched render names it with its SHA-256,
/// - SHA256SUMS names it, and it is one of the files that each set has, such as triggers.tsv,
/// and when its bytes still have that checksum. Nothing is found through symbolic links.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace risorius::stimuli {

/// The line by which the script of a job array is known.
inline constexpr const char* kJobScriptMark =
    "# A part of a stimulus set, made by one task of a job array.";

/// Throws Error unless the folder is missing, holds no file, or was begun by `batch` for a design of this name. An empty name: for any.
void check_own_folder(const std::filesystem::path& folder, const std::string& design);

/// The files, relative to the folder. Sidecars and records are among them.
std::set<std::filesystem::path> own_files(const std::filesystem::path& folder);

/// The files of unmatched renders alone.
std::set<std::filesystem::path> own_renders(const std::filesystem::path& folder);

}  // namespace risorius::stimuli
