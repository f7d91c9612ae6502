// SPDX-License-Identifier: MIT
/// \file
/// The skin shaded once per pixel and looked up by the samples of finer surfaces: shading takes far longer than visibility, and the colour
/// inside of a face changes little within a pixel.
///
/// Each sample takes the colour of its own pixel, or of the neighbour that lies nearest to it in depth, after Chajdas, McGuire
/// and Luebke 2011, Subpixel Reconstruction Antialiasing.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/picture_cells.h"
#include "risorius/render/detail/shader_constants.h"

namespace risorius::render {

/// The greatest depth, 0..1, in cells of the picture; 1 where some of a cell shows no skin.
struct FarthestSkin {
    static constexpr int kCell = 16;  ///< places along each side of a cell
    int columns = 0, rows = 0;
    float width = 0, height = 0;  ///< of the picture, in cells
    std::vector<float> depth;     ///< rows from the bottom
};

class SkinLayer {
  public:
    /// For tiles of so many pixels with `samples` per pixel and side, `shaded` of which are shaded; `constants` of Lights.
    /// The context must be current.
    SkinLayer(int width_px, int height_px, int samples, int shaded,
              const ShaderConstants& constants);
    ~SkinLayer();
    SkinLayer(const SkinLayer&) = delete;
    SkinLayer& operator=(const SkinLayer&) = delete;

    /// Skin is to be shaded into the layer; its part of this size is cleared.
    void begin(int width_px, int height_px);
    /// Skin is to be drawn as it was shaded into the bound framebuffer of bytes.
    void use() const;

    /// How far away the skin in the layer is at most, cell by cell, within the box; elsewhere it is taken to be missing. Waits for the drawing.
    const FarthestSkin& farthest(const ClipBox& box);

    /// Its places as they were shaded, rows from the bottom: colour in bytes of sRGB, and the distance (shader_lookup.cpp). Those
    /// beside the rectangle, px of the picture, are not brought up to date.
    const std::vector<std::uint8_t>& read(const PixelBox& box);
    const std::vector<std::uint8_t>& places() const { return rgba_; }  ///< read last
    int shaded() const { return shaded_; }

  private:
    int shaded_;
    std::vector<std::uint8_t> rgba_;
    FarthestSkin farthest_;
    std::vector<float> depths_;
    int drawn_width_ = 0, drawn_height_ = 0;
    GlProgram program_;
    GLuint framebuffer_ = 0, colour_ = 0, bytes_ = 0, depth_ = 0;
};

}  // namespace risorius::render
