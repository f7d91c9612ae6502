// SPDX-License-Identifier: MIT
/// \file
/// Classifies the cells of a tile, so that as few of them as possible are drawn in samples.
///
/// Terms: a sample is a point of a pixel where visibility is tested; a pixel has `samples` x `samples` of them. The skin layer
/// (skin_layer.h) is a picture of the skin alone, shaded at `shaded` x `shaded` points per pixel, which are called places. A cell
/// is a square of kSide_px x kSide_px pixels.
///
/// There are three kinds of cells. A cell that shows only smooth skin is copied from the skin layer. A cell in which nothing is
/// drawn is filled with background. All other cells are drawn in samples.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace risorius::render {

/// A bounding box in clip space after division by w: -1 at the left and lower border of the picture, 1 at the right and upper
/// border.
struct ClipBox {
    float left = 1e9F, right = -1e9F, low = 1e9F, high = -1e9F;
    bool behind = false;  ///< part of it lies behind the camera, so its position is unknown

    void add(float x, float y, float w) {
        left = std::min(left, x);
        right = std::max(right, x);
        low = std::min(low, y);
        high = std::max(high, y);
        behind |= w <= 0;
    }
    void add(const ClipBox& other) {
        left = std::min(left, other.left);
        right = std::max(right, other.right);
        low = std::min(low, other.low);
        high = std::max(high, other.high);
        behind |= other.behind;
    }
};

/// Pixels [left, right) x [low, high), from the lower left corner.
struct PixelBox {
    int left, right, low, high;
};

class PictureCells {
  public:
    static constexpr int kSide_px = 4;

    /// Starts a tile; all cells are empty.
    void begin(int width_px, int height_px);

    /// Records that skin of the skin layer lies in the box.
    void touch(const ClipBox& box) { add(box, kTouched); }
    /// The same of hair, where only larger steps in distance need samples.
    void touch_hair(const ClipBox& box) { add(box, kTouched | kHairy); }
    /// Records that something in the box must be drawn in samples.
    void mark(const ClipBox& box) { add(box, kTouched | kSampled); }
    void mark_all() { std::fill(cells_.begin(), cells_.end(), kTouched | kSampled); }

    /// Bounding box of all touched cells.
    PixelBox touched() const;

    /// Marks the touched cells that need samples: all but those that skin covers completely and without a step in distance. Locks of
    /// hair lie some millimetres over each other, and their texture hides the edges between them.
    /// `rgba`: the skin layer, `shaded` x `shaded` places per pixel, rows from the bottom, with the distance in alpha (see
    /// shader_lookup.cpp).
    void find_steps(const std::vector<std::uint8_t>& rgba, int shaded);

    /// Whether the box overlaps a cell that needs samples.
    bool needs_samples(const ClipBox& box) const;

    enum class Kind { kEmpty, kSkin, kSampled };
    Kind at(int column, int row) const {
        const std::uint8_t cell = cells_[index(column, row)];
        return cell == 0 ? Kind::kEmpty : (cell & kSampled) != 0 ? Kind::kSampled : Kind::kSkin;
    }
    int columns() const { return columns_; }
    int rows() const { return rows_; }

  private:
    static constexpr std::uint8_t kTouched = 1, kSampled = 2, kHairy = 4;
    struct Range {
        int from_column, to_column, from_row, to_row;
    };
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }
    Range range(const ClipBox& box) const;
    void add(const ClipBox& box, std::uint8_t what);

    int width_px_ = 0, height_px_ = 0, columns_ = 0, rows_ = 0;
    std::vector<std::uint8_t> cells_;  ///< rows from the bottom
    std::vector<std::uint8_t> away_, steps_;
};

}  // namespace risorius::render
