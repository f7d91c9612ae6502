// SPDX-License-Identifier: MIT
/// \file
/// Finds the picture that a material names. Files come from other computers: with the folder of a Windows disk before the name
/// ("C:\scans\anna\skin.png"), or with other letter cases.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace risorius::io::detail {

/// Looks for pictures, and remembers the folders that it has listed.
class PicturePlaces {
  public:
    /// The file that `name` means in the folder `beside`: the one at this path, else the one of this name in `beside`, else one of
    /// those in other letter cases. The path as it is named when there is no such file.
    std::filesystem::path find(const std::filesystem::path& beside, std::string name);

  private:
    /// The names in a folder by their small letters
    const std::map<std::string, std::string>& names_in(const std::filesystem::path& folder);

    std::map<std::filesystem::path, std::map<std::string, std::string>> listed_;
};

}  // namespace risorius::io::detail
