// SPDX-License-Identifier: MIT
#include "risorius/render/detail/framebuffer.h"

#include <algorithm>

#include "risorius/core/error.h"

namespace risorius::render {
namespace {

constexpr int kTileSide_samples = 4096;  ///< of the framebuffer; larger pictures are drawn in tiles

}  // namespace

void check_range(const char* field, int value, int min, int max) {
    if (value < min || value > max)
        throw Error(field, std::to_string(min) + ".." + std::to_string(max), std::to_string(value));
}

Framebuffer::Framebuffer(int width, int height, Colour colour) {
    const bool floats = colour == Colour::kLinearFloats;
    constexpr std::size_t kBeside = 200'000'000;
    require_memory(kBeside + (floats ? 20u : 8u) * static_cast<std::size_t>(width) * height);
    glGenTextures(2, colours_);
    glBindTexture(GL_TEXTURE_2D, colours_[0]);
    glTexStorage2D(GL_TEXTURE_2D, 1, floats ? GL_RGBA32F : GL_SRGB8_ALPHA8, width, height);
    if (!floats) glTextureView(colours_[1], GL_TEXTURE_2D, colours_[0], GL_R32UI, 0, 1, 0, 1);
    glGenRenderbuffers(1, &depth_);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glGenFramebuffers(2, framebuffers_);
    for (const std::size_t k : {1, 0}) {
        if (k == 1 && floats) continue;
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[k]);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colours_[k], 0);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw RunError("the OpenGL framebuffer is incomplete");
    }
}

Framebuffer::~Framebuffer() {
    glDeleteFramebuffers(2, framebuffers_);
    glDeleteRenderbuffers(1, &depth_);
    glDeleteTextures(2, colours_);
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

void TiledPicture::read_back(const Tile& tile, const Resolve& resolve, const PictureCells& cells,
                             const std::vector<std::uint8_t>& layer, int shaded, Image& image) {
    using Kind = PictureCells::Kind;
    constexpr int kSide = PictureCells::kSide_px;
    // Gaps of up to this many cells are read too, because this is faster than another read.
    constexpr int kGap = 4;
    const auto n = static_cast<std::size_t>(supersampling_), s = static_cast<std::size_t>(shaded);
    const std::size_t layer_row = static_cast<std::size_t>(tile.width) * s * 4;
    const auto end_px = [&](int column) { return std::min((column + 1) * kSide, tile.width); };
    const auto next = [&](int row, int column,
                          Kind kind) {  // the next cell of a kind, starting here
        while (column < cells.columns() && cells.at(column, row) != kind) ++column;
        return column;
    };
    for (int row = 0; row < cells.rows(); ++row) {
        const int low = row * kSide, height = std::min(kSide, tile.height - low);
        const auto each_row = [&](int from_column, int to_column, auto&& fill) {
            const int x = from_column * kSide;
            const auto count = static_cast<std::size_t>(end_px(to_column) - x);
            for (int y = 0; y < height; ++y)
                fill(static_cast<std::size_t>(x), static_cast<std::size_t>(y), count,
                     image.pixel(tile.x + x, tile.y + tile.height - 1 - low - y));
        };
        for (int column = 0; column < cells.columns();) {
            const Kind kind = cells.at(column, row);
            int last = column;
            while (last + 1 < cells.columns() && cells.at(last + 1, row) == kind) ++last;
            if (kind == Kind::kEmpty) {
                each_row(column, last,
                         [&](std::size_t, std::size_t, std::size_t count, std::uint8_t* out) {
                             resolve.empty_row(count, out);
                         });
            } else if (kind == Kind::kSkin) {
                each_row(column, last,
                         [&](std::size_t x, std::size_t y, std::size_t count, std::uint8_t* out) {
                             const std::size_t place =
                                 (static_cast<std::size_t>(low) + y) * s * layer_row + x * s * 4;
                             resolve.opaque_row(layer.data() + place, s, layer_row, count, out);
                         });
            }
            column = last + 1;
        }
        for (int column = next(row, 0, Kind::kSampled); column < cells.columns();) {
            int last = column;
            for (int other = column; other < cells.columns() && other - last <= kGap;
                 other = next(row, other + 1, Kind::kSampled))
                last = other;
            const int x0 = column * kSide, width = end_px(last) - x0;
            glReadPixels(x0 * supersampling_, low * supersampling_, width * supersampling_,
                         height * supersampling_, GL_RGBA, GL_UNSIGNED_BYTE, samples_.data());
            const std::size_t sample_row = static_cast<std::size_t>(width) * n * 4;
            for (int c = column; c <= last; ++c)
                if (cells.at(c, row) == Kind::kSampled)
                    each_row(
                        c, c,
                        [&](std::size_t x, std::size_t y, std::size_t count, std::uint8_t* out) {
                            const std::size_t place =
                                y * n * sample_row + (x - static_cast<std::size_t>(x0)) * n * 4;
                            resolve.row(samples_.data() + place, n, sample_row, count, out);
                        });
            column = next(row, last + 1, Kind::kSampled);
        }
    }
}

}  // namespace risorius::render
