// SPDX-License-Identifier: MIT
#include "risorius/render/detail/part_texture.h"

#include <algorithm>

#include "risorius/core/error.h"
#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/smooth_normals.h"
#include "risorius/render/texture_square.h"

namespace risorius::render {
namespace {

struct PartCorner {
    float texcoord[2], rest[3], normal[3], crown_height;
};

std::string part_shader(Material material) {
    if (material == Material::kEye) return eye_texture_shader();
    if (material == Material::kTeeth) return teeth_texture_shader();
    return mucosa_texture_shader(material == Material::kTongue);
}

/// A framebuffer of floats that is bound during its lifetime; afterwards the previous vertex array is bound again.
class FloatSquare {
  public:
    explicit FloatSquare(int side_px) {
        glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &outer_);
        glGenVertexArrays(1, &array_);
        glBindVertexArray(array_);
        glGenBuffers(1, &corners_);
        glBindBuffer(GL_ARRAY_BUFFER, corners_);
        glGenTextures(1, &texture_);
        glBindTexture(GL_TEXTURE_2D, texture_);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, side_px, side_px);
        glGenFramebuffers(1, &framebuffer_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
        glViewport(0, 0, side_px, side_px);
        glDisable(GL_DEPTH_TEST);
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    ~FloatSquare() {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteTextures(1, &texture_);
        glBindVertexArray(static_cast<GLuint>(outer_));
        glDeleteBuffers(1, &corners_);
        glDeleteVertexArrays(1, &array_);
    }
    FloatSquare(const FloatSquare&) = delete;
    FloatSquare& operator=(const FloatSquare&) = delete;

  private:
    GLint outer_ = 0;
    GLuint array_ = 0, corners_ = 0, texture_ = 0, framebuffer_ = 0;
};

}  // namespace

Image unfold_part(const Scene& scene, const Materials& materials, Material material, int side_px,
                  const std::vector<double>& crown_height) {
    std::vector<const Surface*> surfaces;
    std::vector<const Triangles*> triangles;
    for (const Surface& surface : scene.surfaces)
        if (surface.material == material && surface.texcoords.rows() > 0) {
            surfaces.push_back(&surface);
            triangles.push_back(&surface.triangles);
        }
    // The left eye is drawn last.
    std::stable_sort(surfaces.begin(), surfaces.end(),
                     [](const Surface* a, const Surface* b) { return a->eye > b->eye; });
    Image image(side_px, side_px);
    if (surfaces.empty()) return image;
    std::vector<float> positions, normals(3 * static_cast<std::size_t>(scene.rest.rows()));
    for (long v = 0; v < scene.rest.rows(); ++v)
        for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(scene.rest(v, k)));
    SmoothNormals(scene.rest, triangles).compute(positions, normals);

    const FloatSquare square(side_px);
    const GlProgram program("texture of material " + std::to_string(static_cast<int>(material)),
                            part_texture_vertex_shader(), part_shader(material));
    program.use();
    GLuint index = 0;
    for (const auto& [count, offset] : {std::pair{2, offsetof(PartCorner, texcoord)},
                                        {3, offsetof(PartCorner, rest)},
                                        {3, offsetof(PartCorner, normal)},
                                        {1, offsetof(PartCorner, crown_height)}}) {
        glEnableVertexAttribArray(index);
        glVertexAttribPointer(index++, count, GL_FLOAT, GL_FALSE, sizeof(PartCorner),
                              reinterpret_cast<const void*>(offset));
    }
    for (const Surface* surface : surfaces) {
        materials.tell_colours(program, material, std::max(surface->eye, 0));
        std::vector<PartCorner> corners;
        for (Eigen::Index c = 0; c < surface->triangles.size(); ++c) {
            const auto v = static_cast<std::size_t>(surface->triangles(c / 3, c % 3));
            PartCorner& corner = corners.emplace_back();
            for (int k = 0; k < 2; ++k)
                corner.texcoord[k] = static_cast<float>(surface->texcoords(c, k));
            std::copy_n(&positions[3 * v], 3, corner.rest);
            std::copy_n(&normals[3 * v], 3, corner.normal);
            corner.crown_height = crown_height.empty() ? 0.7F : static_cast<float>(crown_height[v]);
        }
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(PartCorner)),
                     corners.data(), GL_STATIC_DRAW);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
    }

    // Rows from the bottom
    std::vector<float> row(4 * static_cast<std::size_t>(side_px));
    for (int y = 0; y < side_px; ++y) {
        glReadPixels(0, y, side_px, 1, GL_RGBA, GL_FLOAT, row.data());
        for (int x = 0; x < side_px; ++x) {
            const float* from = &row[4 * static_cast<std::size_t>(x)];
            if (from[3] == 0) continue;
            std::uint8_t* to = image.pixel(x, side_px - 1 - y);
            for (int k = 0; k < 3; ++k) to[k] = srgb_byte(from[k]);
            to[3] = 255;
        }
    }
    return image;
}

}  // namespace risorius::render
