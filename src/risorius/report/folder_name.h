// Names that come from files, as names of files and folders that any system takes.
#pragma once

#include <set>
#include <string>

namespace risorius::report {

/// Letters, digits, "_" and "-" alone, and unlike any of `taken` even where capitals count as small letters; added to them.
std::string folder_name(const std::string& name, std::set<std::string>& taken);

}  // namespace risorius::report
