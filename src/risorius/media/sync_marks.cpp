// SPDX-License-Identifier: MIT
#include "risorius/media/sync_marks.h"

#include <algorithm>
#include <array>

#include "risorius/core/known_names.h"

namespace risorius::media {

namespace {

constexpr int kBits = 20;

struct MarkBox {
    int x, y, width, height;
};

MarkBox box_in(Corner corner, int width, int height, const Image& image) {
    const bool right = corner == Corner::kUpperRight || corner == Corner::kLowerRight;
    const bool low = corner == Corner::kLowerLeft || corner == Corner::kLowerRight;
    return {right ? image.width_px - width : 0, low ? image.height_px - height : 0, width, height};
}

void fill_box(const MarkBox& box, bool white, Image& image) {
    const std::uint8_t level = white ? 255 : 0;
    for (int y = std::max(0, box.y); y < std::min(image.height_px, box.y + box.height); ++y)
        for (int x = std::max(0, box.x); x < std::min(image.width_px, box.x + box.width); ++x) {
            std::uint8_t* pixel = image.pixel(x, y);
            for (int k = 0; k < 3; ++k) pixel[k] = level;
            pixel[3] = 255;
            if (image.deep.empty()) continue;
            std::uint16_t* deep = image.deep.data() + (pixel - image.rgba.data());
            for (int k = 0; k < 3; ++k) deep[k] = static_cast<std::uint16_t>(257 * level);
            deep[3] = 65535;
        }
}

std::array<bool, kCounterCells> cells_of(int frame) {
    std::array<bool, kCounterCells> cells{};
    cells.front() = cells.back() = true;
    bool odd = false;
    for (int bit = 0; bit < kBits; ++bit) {
        const bool set = (frame >> (kBits - 1 - bit) & 1) != 0;
        cells[static_cast<std::size_t>(2 + bit)] = set;
        odd = odd != set;
    }
    cells[2 + kBits] = odd;
    return cells;
}

}  // namespace

const std::vector<std::string>& corner_names() {
    static const std::vector<std::string> names{"upper_left", "upper_right", "lower_left",
                                                "lower_right"};
    return names;
}

Corner corner_named(const std::string& name, const std::string& place) {
    return static_cast<Corner>(index_of_name(place, name, corner_names()));
}

void draw_photodiode(Corner corner, int side_px, bool lit, Image& image) {
    fill_box(box_in(corner, side_px, side_px, image), lit, image);
}

void draw_frame_counter(Corner corner, int cell_px, int frame, Image& image) {
    const MarkBox strip = box_in(corner, kCounterCells * cell_px, cell_px, image);
    const std::array<bool, kCounterCells> cells = cells_of(frame);
    for (std::size_t i = 0; i < cells.size(); ++i)
        fill_box({strip.x + static_cast<int>(i) * cell_px, strip.y, cell_px, cell_px}, cells[i],
                 image);
}

std::optional<int> read_frame_counter(Corner corner, int cell_px, const Image& image) {
    const MarkBox strip = box_in(corner, kCounterCells * cell_px, cell_px, image);
    if (strip.x < 0 || strip.y < 0) return std::nullopt;
    std::array<bool, kCounterCells> cells{};
    for (std::size_t i = 0; i < cells.size(); ++i) {
        // Only the inner half of a cell counts, because encoders blur its edge.
        long sum = 0, count = 0;
        const int x0 = strip.x + static_cast<int>(i) * cell_px, inset = cell_px / 4;
        for (int y = strip.y + inset; y < strip.y + cell_px - inset; ++y)
            for (int x = x0 + inset; x < x0 + cell_px - inset; ++x, ++count)
                sum += image.pixel(x, y)[1];
        const double level = static_cast<double>(sum) / static_cast<double>(count);
        if (level > 80 && level < 175) return std::nullopt;
        cells[i] = level > 128;
    }
    int frame = 0;
    for (int bit = 0; bit < kBits; ++bit)
        frame = 2 * frame + (cells[static_cast<std::size_t>(2 + bit)] ? 1 : 0);
    return cells == cells_of(frame) ? std::optional(frame) : std::nullopt;
}

}  // namespace risorius::media
