// SPDX-License-Identifier: MIT
#include "risorius/render/detail/fibre_texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "risorius/render/detail/paint_strokes.h"

namespace risorius::render {
namespace {

constexpr int kAcross = 512, kAlong = 128;  ///< texels

/// Noise on a repeating lattice, interpolated smoothly between the lattice points.
class FibreNoise {
  public:
    FibreNoise(int across, int along, unsigned seed) : across_(across), along_(along) {
        RandomSequence random(seed);
        for (int i = 0; i < across * along; ++i) values_.push_back(random.next());
    }
    double at(double s, double t) const {  // 0..1 over the tile
        const double x = s * across_, y = t * along_;
        const int i = static_cast<int>(x), j = static_cast<int>(y);
        const double u = smooth(x - i), v = smooth(y - j);
        return (1 - v) * ((1 - u) * knot(i, j) + u * knot(i + 1, j)) +
               v * ((1 - u) * knot(i, j + 1) + u * knot(i + 1, j + 1));
    }

  private:
    static double smooth(double t) { return t * t * (3 - 2 * t); }
    double knot(int i, int j) const {
        return values_[static_cast<std::size_t>(j % along_ * across_ + i % across_)];
    }
    int across_, along_;
    std::vector<double> values_;
};

}  // namespace

GLuint make_fibres() {
    const FibreNoise bundles(64, 32, 11), strands(160, 64, 23);
    std::vector<double> height, strand;
    for (int y = 0; y < kAlong; ++y)
        for (int x = 0; x < kAcross; ++x) {
            const double s = (x + 0.5) / kAcross, t = (y + 0.5) / kAlong;
            strand.push_back(strands.at(s, t));
            height.push_back(0.6 * bundles.at(s, t) + 0.4 * strand.back());
        }
    std::vector<std::uint8_t> texels;
    const auto byte = [](double v) {
        return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0)));
    };
    for (int y = 0; y < kAlong; ++y)
        for (int x = 0; x < kAcross; ++x) {
            const auto at = [&](int i) {
                return static_cast<std::size_t>(y * kAcross + (i + kAcross) % kAcross);
            };
            texels.push_back(byte(height[at(x)]));
            texels.push_back(byte(0.5 + height[at(x + 1)] - height[at(x - 1)]));
            texels.push_back(byte(strand[at(x)]));
            texels.push_back(255);
        }
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 8, GL_RGBA8, kAcross, kAlong);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kAcross, kAlong, GL_RGBA, GL_UNSIGNED_BYTE,
                    texels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

}  // namespace risorius::render
