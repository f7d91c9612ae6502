#include "render/detail/framebuffer.h"

#include <algorithm>

#include "core/error.h"

namespace risorius::render {
namespace {

constexpr int kTileSide_samples = 4096;  ///< of the framebuffer; larger pictures are drawn in tiles

}  // namespace

void check_range(const char* field, int value, int least, int most) {
    if (value < least || value > most)
        throw Error(field, std::to_string(least) + ".." + std::to_string(most),
                    std::to_string(value));
}

Framebuffer::Framebuffer(int width, int height, Colour colour) {
    glGenRenderbuffers(2, buffers_);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers_[0]);
    glRenderbufferStorage(GL_RENDERBUFFER,
                          colour == Colour::kLinearFloats ? GL_RGBA32F : GL_SRGB8_ALPHA8, width,
                          height);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers_[1]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[0]);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers_[1]);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw RunError("the OpenGL framebuffer is incomplete");
}

Framebuffer::~Framebuffer() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(2, buffers_);
}

TiledPicture::TiledPicture(int width_px, int height_px, int supersampling)
    : width_(width_px), height_(height_px), supersampling_(supersampling) {
    const int side = kTileSide_samples / supersampling;
    tile_width_ = std::min(width_px, side);
    tile_height_ = std::min(height_px, side);
    samples_.resize(static_cast<std::size_t>(tile_width_samples()) *
                    static_cast<std::size_t>(tile_height_samples()) * 4);
}

std::vector<Tile> TiledPicture::tiles() const {
    std::vector<Tile> tiles;
    for (int y = 0; y < height_; y += tile_height_)
        for (int x = 0; x < width_; x += tile_width_)
            tiles.push_back(
                {x, y, std::min(tile_width_, width_ - x), std::min(tile_height_, height_ - y)});
    return tiles;
}

Eigen::Matrix4d TiledPicture::crop(const Tile& tile) const {
    const double w = width_, h = height_;
    Eigen::Matrix4d crop = Eigen::Matrix4d::Identity();
    crop(0, 0) = w / tile.width;
    crop(1, 1) = h / tile.height;
    crop(0, 3) = (w - 2.0 * tile.x - tile.width) / tile.width;
    crop(1, 3) = (2.0 * tile.y + tile.height - h) / tile.height;
    return crop;
}

void TiledPicture::set_viewport(const Tile& tile) const {
    glViewport(0, 0, tile.width * supersampling_, tile.height * supersampling_);
}

void TiledPicture::read_back(const Tile& tile, const Resolve& resolve, Image& image) {
    const int width = tile.width * supersampling_, height = tile.height * supersampling_;
    if (!deep_) {
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, samples_.data());
        resolve(samples_, supersampling_, tile, image);
        return;
    }
    deep_samples_.resize(samples_.size());
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, deep_samples_.data());
    if (image.deep.empty()) image.deep.resize(image.rgba.size());
    deep_->resolve(deep_samples_, supersampling_, tile, image);
}

}  // namespace risorius::render
