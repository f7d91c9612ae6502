// SPDX-License-Identifier: MIT
#include "risorius/render/detail/garment_layer.h"

#include <utility>

#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

constexpr std::size_t kClothFloats = 8;

void fill_elements(GLuint buffer, const std::vector<unsigned>& indices, GLenum use) {
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices.size() * sizeof(unsigned)), indices.data(), use);
}

}  // namespace

GarmentLayer::GarmentLayer(const Scene& scene, Garment garment, const Camera& camera,
                           const ShaderConstants& constants, bool layer)
    : garment_(std::move(garment)), camera_(camera.eye_point()) {
    if (empty()) return;
    ShaderConstants toned = constants;
    toned.set("garment_tone", linear_from_srgb(scene.appearance.garment_tone));
    program_ = std::make_unique<GlProgram>("garment", toned.in(garment_vertex_shader()),
                                           toned.in(garment_shader(layer)));
    GLint outer = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &outer);
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    for (GLuint* buffer : {&buffer_, &elements_, &sampled_}) glGenBuffers(1, buffer);
    fill_elements(elements_, garment_.triangles, GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    GLuint location = 0;
    std::size_t offset = 0;
    for (const int size : {3, 3, 2}) {  // position, normal, cloth
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location++, size, GL_FLOAT, GL_FALSE, kClothFloats * sizeof(float),
                              reinterpret_cast<const void*>(offset * sizeof(float)));
        offset += static_cast<std::size_t>(size);
    }
    glBindVertexArray(static_cast<GLuint>(outer));
}

GarmentLayer::~GarmentLayer() {
    const GLuint buffers[] = {buffer_, elements_, sampled_};
    glDeleteBuffers(3, buffers);
    glDeleteVertexArrays(1, &array_);
}

void GarmentLayer::upload(const Points& positions) {
    if (empty()) return;
    constexpr double kNeckRadius_m = 0.06;  // where patterns have their size
    // Cloth is nearer to the camera than it is, on the same ray: a skin layer tells surfaces apart by their distance.
    constexpr double kNearer_m = 0.008;
    PosedGarment posed = pose_garment(garment_, positions);
    posed.positions +=
        kNearer_m * ((-posed.positions).rowwise() + camera_.transpose()).rowwise().normalized();
    vertices_.clear();
    for (std::size_t i = 0; i < garment_.vertices.size(); ++i) {
        const GarmentVertex& v = garment_.vertices[i];
        const auto row = static_cast<Eigen::Index>(i);
        for (const Points* three : {&posed.positions, &posed.normals})
            for (int k = 0; k < 3; ++k) vertices_.push_back(static_cast<float>((*three)(row, k)));
        vertices_.push_back(static_cast<float>(v.below_m));
        vertices_.push_back(static_cast<float>(kNeckRadius_m * v.around));
    }
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(float)),
                 vertices_.data(), GL_STREAM_DRAW);
}

void GarmentLayer::draw() const {
    if (empty()) return;
    program_->use();
    glBindVertexArray(array_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(garment_.triangles.size()), GL_UNSIGNED_INT,
                   nullptr);
}

void GarmentLayer::touch(const Eigen::Matrix4f& clip_from_world, PictureCells& cells) {
    boxes_.clear();
    for (std::size_t t = 0; t < garment_.triangles.size(); t += 3) {
        ClipBox box;
        for (std::size_t k = 0; k < 3; ++k) {
            const float* p = vertices_.data() + kClothFloats * garment_.triangles[t + k];
            const Eigen::Vector4f clip = clip_from_world * Eigen::Vector4f(p[0], p[1], p[2], 1.0F);
            box.add(clip.x() / clip.w(), clip.y() / clip.w(), clip.w());
        }
        cells.touch(box);
        boxes_.push_back(box);
    }
}

void GarmentLayer::look_up(const PictureCells& cells) {
    if (empty()) return;
    std::vector<unsigned> sampled;
    for (std::size_t i = 0; i < boxes_.size(); ++i)
        if (cells.needs_samples(boxes_[i]))
            sampled.insert(sampled.end(),
                           garment_.triangles.begin() + static_cast<std::ptrdiff_t>(3 * i),
                           garment_.triangles.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    glBindVertexArray(array_);
    fill_elements(sampled_, sampled, GL_STREAM_DRAW);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(sampled.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace risorius::render
