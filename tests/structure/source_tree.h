// SPDX-License-Identifier: MIT
/// \file
/// The project's own files as text, for tests on how they are written.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "paths.h"

namespace risorius::structure {

inline std::filesystem::path source_dir() { return RISORIUS_SOURCE_DIR; }

inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Files below a folder of the project whose names end in one of these, in order.
inline std::vector<std::filesystem::path> files_below(const std::string& folder,
                                                      const std::set<std::string>& endings) {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path top = source_dir() / folder;
    if (!std::filesystem::exists(top)) return files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(top))
        if (entry.is_regular_file() && endings.contains(entry.path().extension().string()))
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

inline std::string shown(const std::filesystem::path& file) {
    return file.lexically_relative(source_dir()).string();
}

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace risorius::structure
