// SPDX-License-Identifier: MIT
#include "risorius/render/detail/lip_area.h"

#include <algorithm>

namespace risorius::render {

LipArea::LipArea(const std::map<std::string, Vec3>& landmarks) {
    double rearmost = 1e9;
    for (const char* id :
         {"ch_l", "ulc_l", "cph_l", "ls", "cph_r", "ulc_r", "ch_r", "llc_r", "li", "llc_l"}) {
        const auto landmark = landmarks.find(id);
        if (landmark == landmarks.end()) continue;
        border_.push_back(landmark->second.head<2>());
        rearmost = std::min(rearmost, landmark->second.z());
    }
    if (border_.size() < 4) border_.clear();
    if (border_.empty()) return;
    const auto [low, high] = std::minmax_element(
        border_.begin(), border_.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
    behind_m_ = rearmost - 0.1 * (high->x() - low->x());
}

bool LipArea::contains(const Vec3& rest) const {
    if (border_.empty() || rest.z() < behind_m_) return false;
    bool inside = false;  // even-odd rule: counts crossings of a ray to the left
    for (std::size_t i = 0, j = border_.size() - 1; i < border_.size(); j = i++) {
        const Vec2 &a = border_[i], &b = border_[j];
        if ((a.y() > rest.y()) != (b.y() > rest.y()) &&
            rest.x() < (b.x() - a.x()) * (rest.y() - a.y()) / (b.y() - a.y()) + a.x())
            inside = !inside;
    }
    return inside;
}

}  // namespace risorius::render
