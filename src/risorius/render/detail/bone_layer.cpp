// SPDX-License-Identifier: MIT
#include "risorius/render/detail/bone_layer.h"

#include <string>

#include "risorius/core/error.h"
#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

// Linear albedo
const Vec3 kBone(0.66, 0.58, 0.45), kEnamel(0.80, 0.76, 0.66);

constexpr GLuint kOpenness = 8;  ///< vertex attribute; the others are those of VertexAttribute

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
    : surface_(scene.bones.rest, {&sound_triangles(scene)}),
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
    for (GLuint* buffer : {&fixed_buffer_, &elements_}) glGenBuffers(1, buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices.size() * sizeof(unsigned)), indices.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, fixed_buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(open.size() * sizeof(float)), open.data(),
                 GL_STATIC_DRAW);
    glEnableVertexAttribArray(kOpenness);
    glVertexAttribPointer(kOpenness, 1, GL_FLOAT, GL_FALSE, 0, nullptr);
    surface_.attach();

    skin_.use();
    set_colour(skin_, "tone", linear_from_srgb(scene.appearance.skin_tone));
}

BoneLayer::~BoneLayer() {
    for (const GLuint buffer : {fixed_buffer_, elements_}) glDeleteBuffers(1, &buffer);
    glDeleteVertexArrays(1, &array_);
}

void BoneLayer::upload(const Pose& pose) {
    surface_.upload(pose.bone_positions, "pose/bone_positions");
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

    // Only the nearest layer of skin is drawn, so that ears and folds do not show twice.
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
