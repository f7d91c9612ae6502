// SPDX-License-Identifier: MIT
/// \file
/// The poses of a script that have been computed, so that moments are shown again without simulation. The memory of tissue is long: a
/// pose is only valid together with all before it.
#pragma once

#include <string>
#include <vector>

namespace risorius::view {

class Take {
  public:
    static constexpr std::size_t kMostBytes = 512u << 20;

    /// Number of the poses from the start that are valid.
    long valid() const { return static_cast<long>(frames_.size()); }
    bool has(long frame) const { return frame >= 0 && frame < valid(); }
    const std::string& at(long frame) const { return frames_[static_cast<std::size_t>(frame)]; }
    /// Keeps a pose if it is the next one and there is room.
    void put(long frame, std::string pose) {
        if (frame != valid() || bytes_ + pose.size() > kMostBytes) return;
        bytes_ += pose.size();
        frames_.push_back(std::move(pose));
    }
    void invalidate_from(long frame) {
        while (valid() > frame && !frames_.empty()) {
            bytes_ -= frames_.back().size();
            frames_.pop_back();
        }
    }

  private:
    std::vector<std::string> frames_;
    std::size_t bytes_ = 0;
};

}  // namespace risorius::view
