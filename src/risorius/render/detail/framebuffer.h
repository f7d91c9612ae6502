// SPDX-License-Identifier: MIT
/// \file
/// Render targets: colour and depth of one tile of a picture, and the tiles of a picture.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/detail/deep_resolve.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/picture_cells.h"
#include "risorius/render/detail/resolve.h"

namespace risorius::render {

/// Limits of the size of every picture.
constexpr int kMinSide_px = 16;
constexpr int kMaxSide_px = 8192;
constexpr int kMaxSupersampling = 4;

/// Throws Error naming the field for a value outside [min, max].
void check_range(const char* field, int value, int min, int max);

/// A framebuffer with depth and colour. The colour is RGBA: sRGB bytes, or floats in linear light. The context must be current.
class Framebuffer {
  public:
    enum class Colour { kSrgbBytes, kLinearFloats };
    Framebuffer(int width, int height, Colour colour = Colour::kSrgbBytes);
    ~Framebuffer();
    Framebuffer(const Framebuffer&) = delete;
    Framebuffer& operator=(const Framebuffer&) = delete;
    void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[0]); }
    /// Binds the same memory for programs that write the four bytes of sRGB and alpha as one integer. Not for floats.
    void bind_bytes() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[1]); }

  private:
    GLuint colours_[2] = {0, 0}, framebuffers_[2] = {0, 0};
    GLuint depth_ = 0;
};

/// A picture that is drawn in tiles of the size of the framebuffer.
class TiledPicture {
  public:
    TiledPicture(int width_px, int height_px, int supersampling);

    /// Makes later calls of read_back() also write 16 bits per channel over this background. The framebuffer must hold linear
    /// floats.
    void keep_deep(const Background& background) { deep_.emplace(background); }

    std::vector<Tile> tiles() const;
    int tile_width_samples() const { return tile_width_ * supersampling_; }
    int tile_height_samples() const { return tile_height_ * supersampling_; }

    /// Returns the matrix that scales and shifts clip space so that the part of the tile fills the viewport.
    Eigen::Matrix4d crop(const Tile& tile) const;
    void set_viewport(const Tile& tile) const;
    /// Reads the samples of the drawn tile, averages them per pixel, and writes the pixels to the place of the tile in the image.
    void read_back(const Tile& tile, const Resolve& resolve, Image& image);
    /// Does the same only for the cells that need samples. The other cells are filled from `layer`, the skin layer with `shaded`
    /// x `shaded` places per pixel (picture_cells.h), or with background.
    void read_back(const Tile& tile, const Resolve& resolve, const PictureCells& cells,
                   const std::vector<std::uint8_t>& layer, int shaded, Image& image);

  private:
    int width_, height_, supersampling_, tile_width_, tile_height_;
    std::vector<std::uint8_t> samples_;
    std::vector<float> deep_samples_;
    std::optional<DeepResolve> deep_;
};

}  // namespace risorius::render
