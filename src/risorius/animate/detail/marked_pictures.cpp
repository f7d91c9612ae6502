// SPDX-License-Identifier: MIT
#include "risorius/animate/detail/marked_pictures.h"

#include <algorithm>
#include <cmath>

namespace risorius::animate {

MarkedPictures::MarkedPictures(const SyncMarks& marks, const track::ScriptDescription& script,
                               int fps)
    : marks_(marks) {
    if (marks.photodiode)
        photodiode_ = media::corner_named(*marks.photodiode, option_name("photodiode"));
    if (marks.frame_counter)
        counter_ = media::corner_named(*marks.frame_counter, option_name("frame_counter"));
    constexpr double kRounding = 1e-9;  // tolerance for rounding of times
    const auto note = [&](double start_s) {
        event_frames_.push_back(static_cast<int>(std::ceil(start_s * fps - kRounding)));
    };
    for (const track::ExpressionEvent& event : script.expressions) note(event.start_s);
    for (const track::BlinkEvent& event : script.blinks) note(event.start_s);
    std::sort(event_frames_.begin(), event_frames_.end());
}

bool MarkedPictures::lit(int frame) const {
    if (!photodiode_) return false;
    if (marks_.photodiode_shows == "frames") return frame % 2 == 0;
    return std::binary_search(event_frames_.begin(), event_frames_.end(), frame);
}

void MarkedPictures::mark(int frame, Image& image) const {
    if (photodiode_) media::draw_photodiode(*photodiode_, marks_.photodiode_px, lit(frame), image);
    if (counter_) media::draw_frame_counter(*counter_, marks_.frame_counter_px, frame, image);
}

}  // namespace risorius::animate
