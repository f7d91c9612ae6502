// SPDX-License-Identifier: MIT
/// \file
/// The sets of outputs that this process is writing, and who decides: a commit, or a request to stop.
#pragma once

#include <filesystem>
#include <vector>

namespace risorius::detail {

/// Makes a set known to the process while it exists.
class LiveOutput {
  public:
    /// `made`: the folders above that were made for it, the outermost first.
    LiveOutput(const std::filesystem::path& root, const std::filesystem::path& private_folder,
               const std::vector<std::filesystem::path>& made);
    ~LiveOutput();
    LiveOutput(const LiveOutput&) = delete;
    LiveOutput& operator=(const LiveOutput&) = delete;

  private:
    std::filesystem::path private_folder_;
};

/// Exists while a set is being moved to its places. Nothing is abandoned meanwhile.
class Decision {
  public:
    /// Throws Interrupted when the outputs were abandoned before.
    Decision();
    ~Decision();
    Decision(const Decision&) = delete;
    Decision& operator=(const Decision&) = delete;

    /// `last`: no output of the run follows.
    void succeeded(bool last) const;
};

/// Exists while a set removes what it wrote. Without it, the program could end in the middle: the set no longer counts as
/// one that is to be abandoned, and is not gone yet.
class Removal {
  public:
    Removal();
    ~Removal();
    Removal(const Removal&) = delete;
    Removal& operator=(const Removal&) = delete;
};

}  // namespace risorius::detail
