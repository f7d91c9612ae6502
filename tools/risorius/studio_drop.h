// SPDX-License-Identifier: MIT
/// \file
/// Files that a person drops onto the page: they come in pieces and are written into the folder of the project.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "risorius/core/json_cursor.h"

namespace risorius::cli {

class StudioDrop {
  public:
    /// `folder`: the project, canonical.
    explicit StudioDrop(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Begins a file: {"type": "drop", "name": "head.obj", "bytes": 2553871, "replace": false}. A file that was not complete is given
    /// up. Throws Error for a name that is not one of a script, a rig, a mesh or what belongs to a mesh, for more than 200 MB, and when
    /// the file exists and "replace" is not true.
    void begin(const JsonCursor& message);

    /// Whether these bytes from a page are a piece of a file: uint32 2, uint32 0, then the bytes of the file.
    static bool is_piece(const std::string& bytes);
    /// Adds a piece. The last one writes the file, which is returned. Throws Error when no file has begun or it gets too long.
    std::optional<std::filesystem::path> add(const std::string& bytes);

  private:
    std::filesystem::path folder_, file_;
    std::size_t bytes_ = 0;  ///< of the whole file; 0: none has begun
    std::string content_;
};

}  // namespace risorius::cli
