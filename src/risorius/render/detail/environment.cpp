// SPDX-License-Identifier: MIT
#include "risorius/render/detail/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace risorius::render {
namespace {

constexpr int kMirrorHeight = 32;
constexpr double kLampReach_rad = 0.30;  ///< angular radius that contains a sun or a softbox

const float* cell(const Surroundings& map, int row, int column) {
    return map.rgb.data() +
           3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                static_cast<std::size_t>(column));
}
Vec3 colour_of(const Surroundings& map, int row, int column) {
    const float* c = cell(map, row, column);
    return {c[0], c[1], c[2]};
}

/// Averages blocks of the map, so that blurring it is fast.
Surroundings coarser(const Surroundings& map, int height) {
    if (map.height <= height) return map;
    Surroundings out{2 * height, height,
                     std::vector<float>(static_cast<std::size_t>(6 * height * height))};
    for (int row = 0; row < out.height; ++row)
        for (int column = 0; column < out.width; ++column) {
            Vec3 sum = Vec3::Zero();
            int count = 0;
            for (int i = row * map.height / out.height; i < (row + 1) * map.height / out.height;
                 ++i)
                for (int j = column * map.width / out.width;
                     j < (column + 1) * map.width / out.width; ++j) {
                    sum += colour_of(map, i, j);
                    ++count;
                }
            for (int k = 0; k < 3; ++k)
                out.rgb[static_cast<std::size_t>(3 * (row * out.width + column) + k)] =
                    static_cast<float>(sum[k] / std::max(count, 1));
        }
    return out;
}

std::array<double, 9> basis(const Vec3& n) {
    return {1,
            n.x(),
            n.y(),
            n.z(),
            n.x() * n.y(),
            n.y() * n.z(),
            3 * n.z() * n.z() - 1,
            n.x() * n.z(),
            n.x() * n.x() - n.y() * n.y()};
}

}  // namespace

Surroundings sampled(const Radiance& radiance, int height) {
    Surroundings map{2 * height, height, {}};
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            const Vec3 colour = radiance(cell_direction(map, row, column));
            for (int k = 0; k < 3; ++k) map.rgb.push_back(static_cast<float>(colour[k]));
        }
    return map;
}

Vec3 cell_direction(const Surroundings& map, int row, int column) {
    const double polar = std::numbers::pi * (row + 0.5) / map.height;
    const double turn = 2 * std::numbers::pi * ((column + 0.5) / map.width - 0.5);
    return {std::sin(polar) * std::sin(turn), std::cos(polar), std::sin(polar) * std::cos(turn)};
}

double cell_solid_angle(const Surroundings& map, int row) {
    const double top = std::numbers::pi * row / map.height;
    const double bottom = std::numbers::pi * (row + 1) / map.height;
    return (std::cos(top) - std::cos(bottom)) * 2 * std::numbers::pi / map.width;
}

Lamp take_brightest(Surroundings& map) {
    const auto brightness = [](const Vec3& c) { return c.dot(Vec3(0.2126, 0.7152, 0.0722)); };
    double brightest = -1, mean = 0;
    Vec3 towards = Vec3::UnitY();
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            const double b = brightness(colour_of(map, row, column));
            mean += b * cell_solid_angle(map, row) / (4 * std::numbers::pi);
            if (b > brightest) {
                brightest = b;
                towards = cell_direction(map, row, column);
            }
        }
    // A lamp must exceed the mean by this factor; an overcast sky has no lamp.
    const double level = 4 * mean;
    Lamp lamp;
    Vec3 middle = Vec3::Zero();
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            const Vec3 direction = cell_direction(map, row, column),
                       c = colour_of(map, row, column);
            const double b = brightness(c);
            if (b <= level || direction.dot(towards) < std::cos(kLampReach_rad)) continue;
            const Vec3 over = c * (1 - level / b);
            lamp.card += over * cell_solid_angle(map, row) / std::numbers::pi;
            middle += direction * brightness(over) * cell_solid_angle(map, row);
            float* kept = map.rgb.data() + (cell(map, row, column) - map.rgb.data());
            for (int k = 0; k < 3; ++k) kept[k] = static_cast<float>(c[k] * level / b);
        }
    lamp.direction = middle.norm() > 0 ? Vec3(middle.normalized()) : towards;
    return lamp;
}

Irradiance irradiance_of(const Surroundings& map) {
    // The integral of the square of each basis function over the sphere, and the factor by which a cosine lobe over pi scales its
    // band.
    constexpr double pi = std::numbers::pi;
    constexpr std::array<double, 9> kSquare{4 * pi,      4 * pi / 3,  4 * pi / 3,
                                            4 * pi / 3,  4 * pi / 15, 4 * pi / 15,
                                            16 * pi / 5, 4 * pi / 15, 16 * pi / 15};
    Irradiance out;
    out.fill(Vec3::Zero());
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            const auto y = basis(cell_direction(map, row, column));
            const Vec3 light = colour_of(map, row, column) * cell_solid_angle(map, row);
            for (std::size_t i = 0; i < 9; ++i) out[i] += y[i] * light;
        }
    for (std::size_t i = 0; i < 9; ++i)
        out[i] *= (i == 0 ? 1.0 : i < 4 ? 2.0 / 3 : 0.25) / kSquare[i];
    return out;
}

Vec3 irradiance_at(const Irradiance& irradiance, const Vec3& normal) {
    const auto y = basis(normal);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 9; ++i) sum += y[i] * irradiance[i];
    return sum.cwiseMax(0.0);
}

GLuint mirror_texture(const Surroundings& fine, const Vec3& exposure) {
    const Surroundings map = coarser(fine, kMirrorHeight);
    const auto cells = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    std::vector<Vec3> from(cells);
    std::vector<double> angle(cells);
    for (std::size_t i = 0; i < cells; ++i) {
        const int row = static_cast<int>(i) / map.width, column = static_cast<int>(i) % map.width;
        from[i] = cell_direction(map, row, column);
        angle[i] = cell_solid_angle(map, row);
    }
    std::vector<float> layers;
    for (const double roughness : kMirrorRoughness) {
        // The mirrored lobe of GGX is about as wide as a spherical Gaussian of this sharpness, which is half that of D (Wang
        // 2009).
        const double sharpness = 0.5 / std::pow(roughness, 4.0);
        const double min = 1 - 7.0 / sharpness;  // exp(-7), the value at this angle, is negligible
        for (std::size_t i = 0; i < cells; ++i) {
            Vec3 sum = Vec3::Zero();
            double weight = 0;
            for (std::size_t j = 0; j < cells; ++j) {
                const double c = from[i].dot(from[j]);
                if (c < min && j != i) continue;
                const double w = angle[j] * std::exp(sharpness * (c - 1));
                sum += w * Vec3(map.rgb[3 * j], map.rgb[3 * j + 1], map.rgb[3 * j + 2]);
                weight += w;
            }
            const Vec3 mean = (sum / weight).cwiseProduct(exposure);
            for (int k = 0; k < 3; ++k) layers.push_back(static_cast<float>(mean[k]));
        }
    }
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture);
    const auto count = static_cast<GLsizei>(kMirrorRoughness.size());
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_RGB32F, map.width, map.height, count);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, map.width, map.height, count, GL_RGB, GL_FLOAT,
                    layers.data());
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace risorius::render
