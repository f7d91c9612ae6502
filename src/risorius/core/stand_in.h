// SPDX-License-Identifier: MIT
/// \file
/// Lets a run read its own outputs before they appear. A script that is to be written names the sound beside it; both are still
/// in the private folder of an OutputSet, see output_set.h, while the face is drawn.
#pragma once

#include <filesystem>

namespace risorius {

/// While an object of this class exists, who reads `name` gets the bytes of `file`.
class StandIn {
  public:
    StandIn(const std::filesystem::path& name, const std::filesystem::path& file);
    ~StandIn();
    StandIn(const StandIn&) = delete;
    StandIn& operator=(const StandIn&) = delete;

  private:
    std::filesystem::path name_;
};

/// The file to open for a name: that of a StandIn, or the name itself.
std::filesystem::path file_to_read(const std::filesystem::path& name);

}  // namespace risorius
