// SPDX-License-Identifier: MIT
#include "risorius/face/face_team.h"

#include <algorithm>

namespace risorius::face {

FaceTeam::FaceTeam(Face& first, const std::function<Face()>& build, const ThreadLimit& threads)
    : own_(static_cast<std::size_t>(std::clamp(threads.count(), 1, kMaxTeam) - 1)), faces_{&first} {
    parallel_for(static_cast<int>(own_.size()), threads, [&](int i) {
        own_[static_cast<std::size_t>(i)] = std::make_unique<Face>(build());
    });
    for (const auto& face : own_) faces_.push_back(face.get());
    free_ = faces_;
}

void FaceTeam::each(int count, const std::function<void(int, Face&)>& task) {
    parallel_for(count, static_cast<int>(faces_.size()), [&](int i) {
        Face* face = nullptr;
        {
            const std::lock_guard lock(mutex_);
            face = free_.back();
            free_.pop_back();
        }
        const auto give_back = [&] {
            const std::lock_guard lock(mutex_);
            free_.push_back(face);
        };
        try {
            task(i, *face);
        } catch (...) {
            give_back();
            throw;
        }
        give_back();
    });
}

}  // namespace risorius::face
