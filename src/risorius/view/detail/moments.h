// SPDX-License-Identifier: MIT
/// \file
/// Moments of the face while the script was computed, a quarter of a second apart: after an edit, the face goes on from the last one
/// before it, not from the start.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>

#include "risorius/face/kept_face.h"

namespace risorius::view {

class Moments {
  public:
    explicit Moments(std::size_t most_bytes = 128u << 20) : most_bytes_(most_bytes) {}

    /// Whether the moment after a frame is to be kept.
    bool wants(long frame) const { return frame % every_ == 0 && !kept_.contains(frame); }
    /// Keeps a moment. Where there is no room, every other one is dropped.
    void put(long frame, const face::KeptFace& moment) {
        kept_.insert_or_assign(frame, moment);
        while (kept_.size() > 2 && kept_.size() * moment.bytes() > most_bytes_) {
            every_ *= 2;
            std::erase_if(kept_, [&](const auto& one) { return one.first % every_ != 0; });
        }
    }
    void invalidate_from(long frame) { kept_.erase(kept_.lower_bound(frame), kept_.end()); }

    struct Found {
        long frame;
        const face::KeptFace& moment;
    };
    /// The last one that is not after a frame.
    std::optional<Found> last_until(long frame) const {
        const auto after = kept_.upper_bound(frame);
        if (after == kept_.begin()) return std::nullopt;
        return Found{std::prev(after)->first, std::prev(after)->second};
    }
    std::size_t size() const { return kept_.size(); }

  private:
    static constexpr long kEvery = 15;
    std::size_t most_bytes_;
    long every_ = kEvery;
    std::map<long, face::KeptFace> kept_;  // by frame
};

}  // namespace risorius::view
