// SPDX-License-Identifier: MIT
#include "risorius/render/detail/picture_cells.h"

#include <cmath>

namespace risorius::render {
namespace {

/// Step between the distances of neighbours, in units of 1 mm (256 units per turn of 256 mm). Below it, the nearest place is good
/// enough for a sample.
constexpr int kMinStep = 3;
/// The same in hair
constexpr int kMinStepOfHair = 10;

/// Branch-free difference of two distances, for vectorization; distances wrap around at 256.
template <int kLeast>
int apart(std::uint8_t a, std::uint8_t b) {
    constexpr unsigned kMax = kLeast - 1;
    return static_cast<int>(static_cast<std::uint8_t>(a - b + kMax) > 2 * kMax);
}

/// 0: no step; 1: one that counts outside of hair; more: one that counts everywhere.
std::uint8_t step(std::uint8_t a, std::uint8_t b) {
    const int none = static_cast<int>(a == 0) | static_cast<int>(b == 0);
    return static_cast<std::uint8_t>(apart<kMinStep>(a, b) | none |
                                     2 * (apart<kMinStepOfHair>(a, b) | none));
}

}  // namespace

void PictureCells::begin(int width_px, int height_px) {
    width_px_ = width_px;
    height_px_ = height_px;
    columns_ = (width_px + kSide_px - 1) / kSide_px;
    rows_ = (height_px + kSide_px - 1) / kSide_px;
    cells_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
}

PictureCells::Range PictureCells::range(const ClipBox& box) const {
    if (box.behind) return {0, columns_ - 1, 0, rows_ - 1};
    const auto cell = [](float clip, int side_px, int cells) {
        const float at = (0.5F * clip + 0.5F) * static_cast<float>(side_px) / kSide_px;
        return static_cast<int>(std::floor(std::clamp(at, -1.0F, static_cast<float>(cells))));
    };
    // A hundredth of a pixel allows for rounding.
    const float x = 0.02F / static_cast<float>(width_px_),
                y = 0.02F / static_cast<float>(height_px_);
    return {std::max(cell(box.left - x, width_px_, columns_), 0),
            std::min(cell(box.right + x, width_px_, columns_), columns_ - 1),
            std::max(cell(box.low - y, height_px_, rows_), 0),
            std::min(cell(box.high + y, height_px_, rows_), rows_ - 1)};
}

void PictureCells::add(const ClipBox& box, std::uint8_t what) {
    const Range r = range(box);
    for (int row = r.from_row; row <= r.to_row; ++row)
        for (int column = r.from_column; column <= r.to_column; ++column)
            cells_[index(column, row)] |= what;
}

bool PictureCells::needs_samples(const ClipBox& box) const {
    const Range r = range(box);
    for (int row = r.from_row; row <= r.to_row; ++row)
        for (int column = r.from_column; column <= r.to_column; ++column)
            if ((cells_[index(column, row)] & kSampled) != 0) return true;
    return false;
}

PixelBox PictureCells::touched() const {
    PixelBox box{columns_, 0, rows_, 0};
    for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns_; ++column)
            if (cells_[index(column, row)] != 0) {
                box.left = std::min(box.left, column);
                box.right = std::max(box.right, column + 1);
                box.low = std::min(box.low, row);
                box.high = std::max(box.high, row + 1);
            }
    return {box.left * kSide_px, std::min(box.right * kSide_px, width_px_), box.low * kSide_px,
            std::min(box.high * kSide_px, height_px_)};
}

void PictureCells::find_steps(const std::vector<std::uint8_t>& rgba, int shaded) {
    const PixelBox box = touched();
    if (box.left >= box.right) return;
    const auto places = [&](int px) { return static_cast<std::size_t>(px * shaded); };
    const std::size_t width = places(box.right - box.left), height = places(box.high - box.low),
                      side = places(kSide_px);
    // The distances, padded by repeating the border.
    const std::size_t stride = width + 2;
    away_.resize(stride * (height + 2));
    for (std::size_t y = 0; y < height + 2; ++y) {
        const std::size_t row = places(box.low) + std::clamp<std::size_t>(y, 1, height) - 1;
        const std::uint8_t* from = rgba.data() + 4 * (row * places(width_px_) + places(box.left));
        std::uint8_t* to = away_.data() + y * stride;
        for (std::size_t x = 0; x < width; ++x) to[x + 1] = from[4 * x + 3];
        to[0] = to[1];
        to[width + 1] = to[width];
    }
    for (std::size_t first = 0; first < height; first += side) {
        steps_.assign(width, 0);
        for (std::size_t y = first; y < std::min(first + side, height); ++y) {
            const std::uint8_t *here = away_.data() + (y + 1) * stride + 1, *above = here + stride,
                               *below = here - stride;
            std::uint8_t* steps = steps_.data();
            for (std::size_t x = 0; x < width; ++x)
                steps[x] = static_cast<std::uint8_t>(
                    steps[x] | step(here[x], here[x + 1]) | step(here[x], *(here + x - 1)) |
                    step(here[x], above[x]) | step(here[x], below[x]));
        }
        const int row = (box.low * shaded + static_cast<int>(first)) / static_cast<int>(side);
        std::uint8_t* cell = cells_.data() + index(box.left / kSide_px, row);
        for (std::size_t x = 0; x < width; x += side, ++cell) {
            const auto from = steps_.begin() + static_cast<std::ptrdiff_t>(x),
                       to = steps_.begin() + static_cast<std::ptrdiff_t>(std::min(x + side, width));
            const int least = (*cell & kHairy) != 0 ? 1 : 0;
            if (*cell != 0 && std::any_of(from, to, [&](std::uint8_t one) { return one > least; }))
                *cell |= kSampled;
        }
    }
}

}  // namespace risorius::render
