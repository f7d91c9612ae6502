// SPDX-License-Identifier: MIT
/// \file
/// The skin shaded once per pixel and looked up by finer samples. Shading takes far longer than visibility, and the colour inside
/// a face changes little within a pixel.
///
/// Each sample takes the colour of its own pixel, or of the neighbour nearest to it in depth, after Chajdas, McGuire
/// and Luebke 2011, Subpixel Reconstruction Antialiasing.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/picture_cells.h"
#include "risorius/render/detail/shader_constants.h"

namespace risorius::render {

/// The largest depth of the skin, 0..1, in cells of the picture; 1 where a part of a cell shows no skin.
struct FarthestSkin {
    static constexpr int kCell = 16;  ///< places along each side of a cell
    int columns = 0, rows = 0;
    float width = 0, height = 0;  ///< of the picture, in cells
    std::vector<float> depth;     ///< rows from the bottom
};

class SkinLayer {
  public:
    /// For tiles of the given size with `samples` x `samples` per pixel, of which `shaded` x `shaded` are shaded. `constants`: of
    /// Lights. The context must be current.
    SkinLayer(int width_px, int height_px, int samples, int shaded,
              const ShaderConstants& constants);
    ~SkinLayer();
    SkinLayer(const SkinLayer&) = delete;
    SkinLayer& operator=(const SkinLayer&) = delete;

    /// Binds the layer for shading of the skin, and clears a part of the given size.
    void begin(int width_px, int height_px);
    /// Uses the program that copies shaded skin into the bound framebuffer of bytes.
    void use() const;

    /// The largest distance of the skin in the layer, cell by cell within the box; outside the box skin counts as missing. Waits
    /// for the drawing.
    const FarthestSkin& farthest(const ClipBox& box);

    /// The shaded places, rows from the bottom: sRGB bytes and the distance (see shader_lookup.cpp). Only places inside the
    /// rectangle, px of the picture, are up to date.
    const std::vector<std::uint8_t>& read(const PixelBox& box);
    const std::vector<std::uint8_t>& places() const { return rgba_; }  ///< as of the last read()
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
