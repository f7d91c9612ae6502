// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/chimera.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/media/luminance.h"
#include "risorius/stimuli/detail/clip_pictures.h"

namespace risorius::stimuli {

namespace {

constexpr double kSoft = 0.04;  // height of the seam / width of the face
constexpr int kHalfOpaque = 128;

/// Puts a pixel into another one, with a weight. Colours count as much as they are opaque.
template <typename Value>
void mix(const Value* below, double weight, Value* pixel) {
    const double over_a = (1 - weight) * pixel[3], below_a = weight * below[3];
    const double alpha = over_a + below_a;
    for (int k = 0; k < 3 && alpha > 0; ++k)
        pixel[k] =
            static_cast<Value>(std::lround((over_a * pixel[k] + below_a * below[k]) / alpha));
    pixel[3] = static_cast<Value>(std::lround(alpha));
}

/// The height of a landmark in the first frame, px from the top.
double height_of(const animate::FrameRows& rows, const std::string& id, const std::string& place) {
    const int column = rows.column(id + ".v_px");
    if (column < 0) throw Error(place, "a rig with the landmarks n and sn, for chimeric", "none");
    return rows.number(0, column);
}

}  // namespace

Chimera::Chimera(const ClipPlan& plan, const animate::FrameRows& upper, std::vector<Image> lower)
    : lower_(std::move(lower)) {
    const std::string& place = plan.condition.clip;
    const double face_px = width_of_face(upper, place);
    row_px_ = 0.5 * (height_of(upper, "n", place) + height_of(upper, "sn", place));
    height_px_ = std::max(2.0, kSoft * face_px);
    offset_px_ = static_cast<int>(std::lround(plan.condition.control.offset * face_px));
    // Layers get their background later.
    if (!ClipPictures::has_layers(plan) && !plan.transparent)
        background_ = {plan.background[0], plan.background[1], plan.background[2], 255};
}

double Chimera::weight_of_lower(int y) const {
    const double t = std::clamp((y + 0.5 - row_px_) / height_px_ + 0.5, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

void Chimera::measure(const Image& upper, const Image& lower) {
    double sum = 0, count = 0;
    for (int y = 0; y < upper.height_px; ++y) {
        const double weight = weight_of_lower(y);
        if (weight <= 0 || weight >= 1) continue;
        for (int x = 0; x < upper.width_px; ++x) {
            const std::uint8_t *a = upper.pixel(x, y), *b = lower.pixel(x, y);
            if (a[3] < kHalfOpaque || b[3] < kHalfOpaque) continue;
            const double difference = media::relative_luminance(a) - media::relative_luminance(b);
            sum += difference * difference;
            ++count;
        }
    }
    differences_.push_back(count > 0 ? std::sqrt(sum / count) : 0);
}

void Chimera::combine(int frame, Image& upper) {
    const Image& lower = lower_[static_cast<std::size_t>(frame)];
    measure(upper, lower);
    if (lower.deep.empty()) upper.deep.clear();
    for (int y = 0; y < upper.height_px; ++y) {
        const double weight = weight_of_lower(y);
        if (weight <= 0) continue;
        for (int x = 0; x < upper.width_px; ++x) {
            const int from = x - offset_px_;
            const bool inside = from >= 0 && from < upper.width_px;
            const auto at = static_cast<std::size_t>(upper.pixel(x, y) - upper.rgba.data());
            if (upper.deep.empty()) {
                mix(inside ? lower.pixel(from, y) : background_.data(), weight, &upper.rgba[at]);
                continue;
            }
            std::array<std::uint16_t, 4> behind{};
            if (inside)
                std::copy_n(
                    &lower.deep[static_cast<std::size_t>(lower.pixel(from, y) - lower.rgba.data())],
                    4, behind.begin());
            mix(behind.data(), weight, &upper.deep[at]);
            for (std::size_t k = 0; k < 4; ++k)
                upper.rgba[at + k] = static_cast<std::uint8_t>((upper.deep[at + k] + 128U) / 257U);
        }
    }
}

Json Chimera::json() const {
    const double sum = std::accumulate(differences_.begin(), differences_.end(), 0.0);
    const bool any = !differences_.empty();
    return json_object(
        {{"row_px", row_px_},
         {"height_px", height_px_},
         {"offset_px", offset_px_},
         {"difference_mean", any ? sum / static_cast<double>(differences_.size()) : 0.0},
         {"difference_max",
          any ? *std::max_element(differences_.begin(), differences_.end()) : 0.0}});
}

bool Chimera::is_lower(const animate::FrameRows& upper, const std::string& id) const {
    const int height = upper.column(id + ".v_px");
    return height >= 0 && upper.number(0, height) >= row_px_;
}

LandmarkChoice Chimera::landmarks(const animate::FrameRows& upper, bool of_lower) const {
    const std::string x = ".x_mm";
    std::set<std::string> ids;
    for (const std::string& name : upper.names)
        if (name.ends_with(x))
            if (const std::string id = name.substr(0, name.size() - x.size());
                is_lower(upper, id) == of_lower)
                ids.insert(id);
    return LandmarkChoice(std::move(ids));
}

animate::FrameRows Chimera::rows(const animate::FrameRows& upper,
                                 const animate::FrameRows& lower) const {
    animate::FrameRows out = upper;
    for (std::size_t c = 0; c < out.names.size(); ++c) {
        const std::string& name = out.names[c];
        if (!is_of_landmark(name)) continue;
        const std::string id = name.substr(0, name.rfind('.'));
        const int other = lower.column(name);
        if (other < 0 || !is_lower(upper, id)) continue;
        for (std::size_t r = 0; r < out.cells.size() && r < lower.cells.size(); ++r) {
            out.cells[r][c] = lower.cells[r][static_cast<std::size_t>(other)];
            if (offset_px_ != 0 && name.ends_with(".u_px")) {
                char text[32];
                std::snprintf(text, sizeof text, "%.3f",
                              lower.number(static_cast<int>(r), other) + offset_px_);
                out.cells[r][c] = text;
            }
        }
    }
    return out;
}

}  // namespace risorius::stimuli
