// SPDX-License-Identifier: MIT
#include "risorius/render/detail/skin_layer.h"

#include <algorithm>

#include "risorius/core/error.h"
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

std::string with_fraction(int shaded, int samples, const std::string& source) {
    ShaderConstants constants;
    constants.set("shaded_per_sample", static_cast<double>(shaded) / samples);
    return constants.in(source);
}

}  // namespace

SkinLayer::SkinLayer(int width_px, int height_px, int samples, int shaded,
                     const ShaderConstants& constants)
    : shaded_(shaded),
      program_("skin looked up", constants.in(lookup_vertex_shader()),
               with_fraction(shaded, samples, lookup_shader())) {
    const int width = width_px * shaded, height = height_px * shaded;

    // One texture in two views: as sRGB to shade into, and as one integer per pixel to copy from.
    glGenTextures(1, &colour_);
    glBindTexture(GL_TEXTURE_2D, colour_);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, width, height);
    glGenTextures(1, &bytes_);
    glTextureView(bytes_, GL_TEXTURE_2D, colour_, GL_R32UI, 0, 1, 0, 1);
    glBindTexture(GL_TEXTURE_2D, bytes_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glGenRenderbuffers(1, &depth_);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw RunError("the OpenGL framebuffer of the skin is incomplete");
}

SkinLayer::~SkinLayer() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &depth_);
    glDeleteTextures(1, &bytes_);
    glDeleteTextures(1, &colour_);
}

void SkinLayer::begin(int width_px, int height_px) {
    drawn_width_ = width_px * shaded_;
    drawn_height_ = height_px * shaded_;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, drawn_width_, drawn_height_);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_FRAMEBUFFER_SRGB);
}

const FarthestSkin& SkinLayer::farthest(const ClipBox& box) {
    constexpr int kCell = FarthestSkin::kCell;
    farthest_.columns = (drawn_width_ + kCell - 1) / kCell;
    farthest_.rows = (drawn_height_ + kCell - 1) / kCell;
    farthest_.width = static_cast<float>(drawn_width_) / kCell;
    farthest_.height = static_cast<float>(drawn_height_) / kCell;
    farthest_.depth.assign(
        static_cast<std::size_t>(farthest_.columns) * static_cast<std::size_t>(farthest_.rows),
        1.0F);
    // Whole cells, with one more on each side for the pixels beside the box
    const auto cell = [&](float clip, float cells, int by, int max) {
        const float at = (0.5F * std::clamp(clip, -1.0F, 1.0F) + 0.5F) * cells;
        return std::clamp(static_cast<int>(at) + by, 0, max);
    };
    if (!box.behind &&
        (box.left > box.right || box.left > 1 || box.right < -1 || box.low > 1 || box.high < -1))
        return farthest_;
    const int from_x = box.behind ? 0 : cell(box.left, farthest_.width, -1, farthest_.columns),
              to_x = box.behind ? farthest_.columns
                                : cell(box.right, farthest_.width, 2, farthest_.columns),
              from_y = box.behind ? 0 : cell(box.low, farthest_.height, -1, farthest_.rows),
              to_y =
                  box.behind ? farthest_.rows : cell(box.high, farthest_.height, 2, farthest_.rows);
    const int x0 = from_x * kCell, y0 = from_y * kCell,
              drawn_width = std::min(to_x * kCell, drawn_width_) - x0,
              drawn_height = std::min(to_y * kCell, drawn_height_) - y0;
    if (drawn_width <= 0 || drawn_height <= 0) return farthest_;
    const auto width = static_cast<std::size_t>(drawn_width);
    depths_.resize(width * static_cast<std::size_t>(drawn_height));
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glReadPixels(x0, y0, drawn_width, drawn_height, GL_DEPTH_COMPONENT, GL_FLOAT, depths_.data());
    std::vector<float> column(width);
    for (int row = from_y; row < to_y; ++row) {
        std::fill(column.begin(), column.end(), 0.0F);
        for (int y = row * kCell; y < std::min((row + 1) * kCell, drawn_height_); ++y) {
            const float* depths = depths_.data() + static_cast<std::size_t>(y - y0) * width;
            for (std::size_t x = 0; x < width; ++x)
                column[x] = depths[x] > column[x] ? depths[x] : column[x];
        }
        float* cells = farthest_.depth.data() +
                       static_cast<std::size_t>(row) * static_cast<std::size_t>(farthest_.columns) +
                       from_x;
        std::fill(cells, cells + (to_x - from_x), 0.0F);
        for (std::size_t x = 0; x < width; ++x)
            cells[x / kCell] = std::max(cells[x / kCell], column[x]);
    }
    return farthest_;
}

const std::vector<std::uint8_t>& SkinLayer::read(const PixelBox& box) {
    rgba_.resize(4 * static_cast<std::size_t>(drawn_width_) *
                 static_cast<std::size_t>(drawn_height_));
    const int x = box.left * shaded_, y = box.low * shaded_,
              width = (box.right - box.left) * shaded_, height = (box.high - box.low) * shaded_;
    if (width <= 0 || height <= 0) return rgba_;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glPixelStorei(GL_PACK_ROW_LENGTH, drawn_width_);
    glReadPixels(
        x, y, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
        rgba_.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(drawn_width_) +
                            static_cast<std::size_t>(x)));
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    return rgba_;
}

void SkinLayer::use(double beyond_m) const {
    glActiveTexture(GL_TEXTURE0 + kSkinLayerUnit);
    glBindTexture(GL_TEXTURE_2D, bytes_);
    program_.use();
    glUniform1f(program_.location("beyond"), static_cast<float>(beyond_m));
}

}  // namespace risorius::render
