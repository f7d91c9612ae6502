// SPDX-License-Identifier: MIT
#include "risorius/render/detail/own_textures.h"

#include <algorithm>
#include <array>
#include <string>

#include "risorius/core/error.h"
#include "risorius/render/detail/shader_paint.h"
#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

using Corners = std::array<int, 3>;

Corners sorted(Corners corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// Colours are decoded from sRGB before mip levels are averaged.
GLuint texture_of(const Image& image) {
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    int levels = 1;
    while ((std::max(image.width_px, image.height_px) >> levels) > 0) ++levels;
    glTexStorage2D(GL_TEXTURE_2D, levels, GL_SRGB8_ALPHA8, image.width_px, image.height_px);
    // Texture coordinates start at the bottom row.
    for (int y = 0; y < image.height_px; ++y)
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, image.height_px - 1 - y, image.width_px, 1, GL_RGBA,
                        GL_UNSIGNED_BYTE, image.pixel(0, y));
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    return texture;
}

/// Gradient and offset of one texture coordinate as a linear function on the plane of a triangle.
Eigen::Vector4f affine(const std::array<Vec3, 3>& p, const Vec3& value) {
    const Vec3 a = p[1] - p[0], b = p[2] - p[0];
    const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), area = aa * bb - ab * ab;
    Vec3 gradient = Vec3::Zero();
    if (area > 1e-12 * aa * bb) {
        const double u = value[1] - value[0], v = value[2] - value[0];
        gradient = ((bb * u - ab * v) * a + (aa * v - ab * u) * b) / area;
    }
    Eigen::Vector4f out;
    out << gradient.cast<float>(), static_cast<float>(value[0] - gradient.dot(p[0]));
    return out;
}

struct SkinCorner {
    float place[2], depth, texcoord[2];
};

}  // namespace

OwnTextures::OwnTextures(const Scene& scene, const SceneBuffers& buffers) {
    for (const Image& image : scene.textures) textures_.push_back(texture_of(image));
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Surface& surface = scene.surfaces[i];
        if (surface.texture < 0) continue;
        const std::string place = "scene/surfaces/" + std::to_string(i);
        if (surface.texture >= static_cast<int>(scene.textures.size()))
            throw Error(place + "/texture", "less than " + std::to_string(scene.textures.size()),
                        std::to_string(surface.texture));
        if (surface.texcoords.rows() != 3 * surface.triangles.rows())
            throw Error(place + "/texcoords",
                        std::to_string(3 * surface.triangles.rows()) + " rows with a texture",
                        std::to_string(surface.texcoords.rows()));
    }
    for (const Batch& batch : buffers.batches()) {
        if (batch.texture < 0) continue;
        struct Found {
            const Surface* surface;
            Eigen::Index face;
        };
        std::map<Corners, Found> at;
        for (const Surface& surface : scene.surfaces)
            if (surface.material == batch.material && surface.texture == batch.texture)
                for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
                    at[sorted({surface.triangles(f, 0), surface.triangles(f, 1),
                               surface.triangles(f, 2)})] = {&surface, f};
        std::vector<Eigen::Vector4f> places;
        for (int i = batch.first_index; i < batch.first_index + batch.index_count; i += 3) {
            const auto corner = [&](int k) {
                return static_cast<int>(buffers.indices()[static_cast<std::size_t>(i + k)]);
            };
            const Found& found = at.at(sorted({corner(0), corner(1), corner(2)}));
            std::array<Vec3, 3> p;
            Vec3 u, v;
            for (int k = 0; k < 3; ++k) {
                p[static_cast<std::size_t>(k)] =
                    scene.rest.row(found.surface->triangles(found.face, k)).transpose();
                u[k] = found.surface->texcoords(3 * found.face + k, 0);
                v[k] = found.surface->texcoords(3 * found.face + k, 1);
            }
            places.push_back(affine(p, u));
            places.push_back(affine(p, v));
        }
        Places& gl = places_[batch.first_index];
        glGenBuffers(1, &gl.buffer);
        glBindBuffer(GL_TEXTURE_BUFFER, gl.buffer);
        glBufferData(GL_TEXTURE_BUFFER,
                     static_cast<GLsizeiptr>(places.size() * sizeof(Eigen::Vector4f)),
                     places.data(), GL_STATIC_DRAW);
        glGenTextures(1, &gl.texture);
        glBindTexture(GL_TEXTURE_BUFFER, gl.texture);
        glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, gl.buffer);
    }
}

OwnTextures::~OwnTextures() {
    glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
    for (const auto& [first, places] : places_) {
        glDeleteTextures(1, &places.texture);
        glDeleteBuffers(1, &places.buffer);
    }
}

void OwnTextures::bind(const Batch& batch) const {
    if (batch.texture < 0) return;
    glActiveTexture(GL_TEXTURE0 + kOwnColourUnit);
    glBindTexture(GL_TEXTURE_2D, textures_[static_cast<std::size_t>(batch.texture)]);
    glActiveTexture(GL_TEXTURE0 + kOwnPlaceUnit);
    glBindTexture(GL_TEXTURE_BUFFER, places_.at(batch.first_index).texture);
}

void OwnTextures::paint_skin(const Scene& scene, const Vec3& paint_centre,
                             const std::vector<unsigned>& painted) const {
    std::vector<Corners> shown;
    for (std::size_t i = 0; i + 2 < painted.size(); i += 3)
        shown.push_back(sorted({static_cast<int>(painted[i]), static_cast<int>(painted[i + 1]),
                                static_cast<int>(painted[i + 2])}));
    std::sort(shown.begin(), shown.end());

    GLint outer = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &outer);
    GLuint array = 0, buffer = 0;
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    const auto attribute = [](GLuint index, GLint size, std::size_t offset) {
        glEnableVertexAttribArray(index);
        glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(SkinCorner),
                              reinterpret_cast<const void*>(offset));
    };
    attribute(0, 3, offsetof(SkinCorner, place));
    attribute(1, 2, offsetof(SkinCorner, texcoord));
    const GlProgram program("own skin", own_skin_vertex_shader(), own_skin_shader());
    program.use();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
    glClear(GL_DEPTH_BUFFER_BIT);
    glActiveTexture(GL_TEXTURE0 + kOwnColourUnit);
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != Material::kSkin || surface.texture < 0) continue;
        std::vector<SkinCorner> corners;
        for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
            if (!std::binary_search(shown.begin(), shown.end(),
                                    sorted({surface.triangles(f, 0), surface.triangles(f, 1),
                                            surface.triangles(f, 2)})))
                continue;
            for (Eigen::Index k = 0; k < 3; ++k) {
                const Vec3 p = scene.rest.row(surface.triangles(f, k)).transpose();
                const Vec2 place = paint_place(p, paint_centre);
                // As in the paint map, points farther out win the depth test.
                const double depth = 1 - 2 * std::min((p - paint_centre).norm() / 0.5, 1.0);
                corners.push_back({{static_cast<float>(place.x()), static_cast<float>(place.y())},
                                   static_cast<float>(depth),
                                   {static_cast<float>(surface.texcoords(3 * f + k, 0)),
                                    static_cast<float>(surface.texcoords(3 * f + k, 1))}});
            }
        }
        glBindTexture(GL_TEXTURE_2D, textures_[static_cast<std::size_t>(surface.texture)]);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(SkinCorner)),
                     corners.data(), GL_STATIC_DRAW);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindVertexArray(static_cast<GLuint>(outer));
    glDeleteBuffers(1, &buffer);
    glDeleteVertexArrays(1, &array);
}

bool has_own_skin(const Scene& scene) {
    return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& surface) {
        return surface.material == Material::kSkin && surface.texture >= 0;
    });
}

}  // namespace risorius::render
