// The skin shaded once per pixel, for samples of finer surfaces to look up: shading costs far more than finding out what is
// seen, and what lies between the edges of a face changes little within a pixel.
//
// Each sample takes the colour of its own pixel, or of the neighbour that lies nearest to it in depth, after Chajdas, McGuire
// and Luebke 2011, Subpixel Reconstruction Antialiasing.
#pragma once

#include "render/detail/gl_context.h"

namespace risorius::render {

class SkinLayer {
  public:
    /// For tiles of so many pixels with `samples` per pixel and side, `shaded` of which are shaded. The context must be current.
    SkinLayer(int width_px, int height_px, int samples, int shaded);
    ~SkinLayer();
    SkinLayer(const SkinLayer&) = delete;
    SkinLayer& operator=(const SkinLayer&) = delete;

    /// Skin is to be shaded into the layer; its part of this size is cleared.
    void begin(int width_px, int height_px) const;
    /// Skin is to be drawn into the bound framebuffer as it was shaded, in the bytes of sRGB.
    void use() const;

  private:
    int shaded_;
    GlProgram program_;
    GLuint framebuffer_ = 0, colour_ = 0, bytes_ = 0, depth_ = 0;
};

}  // namespace risorius::render
