#include "render/detail/bone_layer.h"

#include <string>

#include "core/error.h"
#include "render/detail/shaders.h"
#include "render/detail/skin_paint.h"

namespace risorius::render {
namespace {

// Linear albedo
const Vec3 kBone(0.66, 0.58, 0.45), kEnamel(0.80, 0.76, 0.66);

constexpr std::size_t kBoneFloats = 6;
constexpr GLuint kOpenness = 8;  ///< vertex attribute; those of the scene's own are VertexAttribute

void bone_attribute(GLuint index, GLint size, std::size_t stride, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE,
                          static_cast<GLsizei>(stride * sizeof(float)),
                          reinterpret_cast<const void*>(offset * sizeof(float)));
}

void set_colour(const GlProgram& program, const char* name, const Vec3& colour) {
    const Eigen::Vector3f f = colour.cast<float>();
    glUniform3fv(program.location(name), 1, f.data());
}

const Triangles& sound_triangles(const Scene& scene) {
    const Triangles& triangles = scene.bones.triangles;
    const auto count = scene.bones.rest.rows();
    if (count == 0 || triangles.rows() == 0) throw Error("scene/bones", "a skull", "none");
    if (triangles.minCoeff() < 0 || triangles.maxCoeff() >= count)
        throw Error(
            "scene/bones/triangles", "vertices 0.." + std::to_string(count - 1),
            std::to_string(triangles.minCoeff()) + ".." + std::to_string(triangles.maxCoeff()));
    if (scene.bones.open.size() != static_cast<std::size_t>(count))
        throw Error("scene/bones/open", std::to_string(count) + " values",
                    std::to_string(scene.bones.open.size()));
    return triangles;
}

}  // namespace

BoneLayer::BoneLayer(const Scene& scene)
    : vertex_count_(scene.bones.rest.rows()),
      smooth_(scene.bones.rest, {&sound_triangles(scene)}),
      bone_("bone", bone_vertex_shader(), bone_shader()),
      skin_("glass skin", glass_vertex_shader(), glass_shader()) {
    const Triangles& triangles = scene.bones.triangles;
    std::vector<unsigned> indices;
    for (Eigen::Index i = 0; i < triangles.size(); ++i)
        indices.push_back(static_cast<unsigned>(triangles.data()[i]));
    index_count_ = static_cast<GLsizei>(indices.size());
    const std::vector<float> open(scene.bones.open.begin(), scene.bones.open.end());

    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    for (GLuint* buffer : {&moving_buffer_, &fixed_buffer_, &elements_}) glGenBuffers(1, buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices.size() * sizeof(unsigned)), indices.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, fixed_buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(open.size() * sizeof(float)), open.data(),
                 GL_STATIC_DRAW);
    bone_attribute(kOpenness, 1, 1, 0);
    glBindBuffer(GL_ARRAY_BUFFER, moving_buffer_);
    bone_attribute(kPosition, 3, kBoneFloats, 0);
    bone_attribute(kNormal, 3, kBoneFloats, 3);

    skin_.use();
    set_colour(skin_, "tone", linear_from_srgb(scene.look.skin_tone));
}

BoneLayer::~BoneLayer() {
    for (const GLuint buffer : {moving_buffer_, fixed_buffer_, elements_})
        glDeleteBuffers(1, &buffer);
    glDeleteVertexArrays(1, &array_);
}

void BoneLayer::upload(const Pose& pose) {
    if (pose.bone_positions.rows() != vertex_count_)
        throw Error("pose/bone_positions", std::to_string(vertex_count_) + " rows",
                    std::to_string(pose.bone_positions.rows()));
    const auto vertices = static_cast<std::size_t>(vertex_count_);
    positions_.resize(3 * vertices);
    for (std::size_t i = 0; i < positions_.size(); ++i)
        positions_[i] = static_cast<float>(pose.bone_positions.data()[i]);
    smooth_.compute(positions_, normals_);
    moving_.resize(kBoneFloats * vertices);
    for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t k = 0; k < 3; ++k) {
            moving_[kBoneFloats * v + k] = positions_[3 * v + k];
            moving_[kBoneFloats * v + 3 + k] = normals_[3 * v + k];
        }
    glBindBuffer(GL_ARRAY_BUFFER, moving_buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(moving_.size() * sizeof(float)),
                 moving_.data(), GL_STREAM_DRAW);
}

void BoneLayer::draw(const SceneBuffers& buffers) const {
    bone_.use();
    set_colour(bone_, "albedo", kBone);
    glUniform1i(bone_.location("closed_in"), 1);
    glBindVertexArray(array_);
    glEnable(GL_CULL_FACE);
    glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
    glDisable(GL_CULL_FACE);

    buffers.bind();
    set_colour(bone_, "albedo", kEnamel);
    glUniform1i(bone_.location("closed_in"), 0);
    for (const Batch& batch : buffers.batches())
        if (batch.material == Material::kTeeth) buffers.draw(batch);

    // Of the skin only what is nearest, so that ears and folds are not seen twice
    skin_.use();
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (const Batch& batch : buffers.batches())
        if (batch.material == Material::kSkin) buffers.draw(batch);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthFunc(GL_LEQUAL);
    for (const Batch& batch : buffers.batches())
        if (batch.material == Material::kSkin) buffers.draw(batch);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
}

}  // namespace risorius::render
