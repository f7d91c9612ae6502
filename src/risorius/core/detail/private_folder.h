// SPDX-License-Identifier: MIT
/// \file
/// The private folder of a set of outputs, ".risorius-XXXXXX" in the folder of the set:
///
///   owner     locked while its process runs. First line: who that is. Each further line: what it claims
///   new/      what is being written, under the names it will have
///   former/   what it took the place of, where the file system cannot exchange two names
///   scratch/  files that are not kept
///   journal   what is moved to its place; there from the decision to the last move
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/detail/checked_file.h"
#include "risorius/core/detail/rename_journal.h"

namespace risorius::detail {

class PrivateFolder {
  public:
    /// Finishes or removes what processes that have ended left in `root`, which must be there, and makes a private folder in it.
    /// Throws RunError.
    explicit PrivateFolder(const std::filesystem::path& root);
    ~PrivateFolder();  ///< removes it, unless keep() was called
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;

    /// Throws OutputInUse when a running process claims the same. `place` is its place in messages.
    void claim(const std::vector<std::string>& what, const std::filesystem::path& place);

    const Places& places() const { return places_; }
    /// Leaves the folder to the next set, which finishes what the journal says.
    void keep() { kept_ = true; }

  private:
    Places places_;
    Descriptor owner_;
    bool kept_ = false;
};

}  // namespace risorius::detail
