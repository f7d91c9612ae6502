// SPDX-License-Identifier: MIT
/// \file
/// The skin layer: a picture of the skin, shaded about once per pixel. The samples of a picture (picture_cells.h) are finer; they
/// test visibility and look their colour up in the layer. Shading takes far longer than visibility, and the colour on a smooth
/// surface changes little within a pixel.
///
/// Each sample takes the colour of its own place in the layer, or of the neighbouring place that is nearest to it in depth.
/// Source: Chajdas, McGuire and Luebke 2011, Subpixel Reconstruction Antialiasing.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/picture_cells.h"
#include "risorius/render/detail/shader_constants.h"

namespace risorius::render {

/// The largest depth of the skin, 0..1, in each cell of the layer; 1 where a part of the cell shows no skin. These cells are not
/// those of PictureCells.
struct FarthestSkin {
    static constexpr int kCell = 16;  ///< number of places along each side of a cell
    int columns = 0, rows = 0;
    float width = 0, height = 0;  ///< of the picture, in cells
    std::vector<float> depth;     ///< rows from the bottom
};

class SkinLayer {
  public:
    /// Makes a layer for tiles of the given size with `samples` x `samples` samples and `shaded` x `shaded` places per pixel.
    /// `constants`: those of Lights. The context must be current.
    SkinLayer(int width_px, int height_px, int samples, int shaded,
              const ShaderConstants& constants);
    ~SkinLayer();
    SkinLayer(const SkinLayer&) = delete;
    SkinLayer& operator=(const SkinLayer&) = delete;

    /// Binds the layer as the framebuffer, so that the skin can be shaded into it, and clears a part of the given size.
    void begin(int width_px, int height_px);
    /// Uses the program that copies shaded skin into the bound framebuffer of bytes. `beyond_m`: what was added to the distances of
    /// what is drawn next.
    void use(double beyond_m = 0) const;

    /// Returns the largest depth of the skin in each cell within the box; outside the box, skin counts as missing. Waits until
    /// the layer has been drawn.
    const FarthestSkin& farthest(const ClipBox& box);

    /// Reads the shaded places, rows from the bottom. Each has four bytes: sRGB and the distance (see shader_lookup.cpp). Only
    /// places inside the rectangle, px of the tile, are up to date.
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
