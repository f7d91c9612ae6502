// SPDX-License-Identifier: MIT
#include "risorius/render/detail/muscle_layer.h"

#include <string>

#include "risorius/core/error.h"
#include "risorius/render/detail/activation_colour.h"
#include "risorius/render/detail/face_order.h"
#include "risorius/render/detail/fibre_texture.h"
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

std::vector<const Triangles*> muscle_triangles(const Scene& scene) {
    std::vector<const Triangles*> lists;
    for (std::size_t i = 0; i < scene.muscles.parts.size(); ++i) {
        const Triangles& triangles = scene.muscles.parts[i].triangles;
        const auto count = scene.muscles.rest.rows();
        if (triangles.size() > 0 && (triangles.minCoeff() < 0 || triangles.maxCoeff() >= count))
            throw Error(
                "scene/muscles/parts/" + std::to_string(i) + "/triangles",
                "vertices 0.." + std::to_string(count - 1),
                std::to_string(triangles.minCoeff()) + ".." + std::to_string(triangles.maxCoeff()));
        lists.push_back(&triangles);
    }
    return lists;
}

void muscle_attribute(GLuint index) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
}

GLuint muscle_texture(GLenum format, int width, int height) {
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

/// clip z = a * distance + b, clip w = distance.
Vec2 depth_terms(const Mat4& clip_from_world) {
    const Eigen::RowVector4d z = clip_from_world.row(2), w = clip_from_world.row(3);
    const double a = z.head<3>().dot(w.head<3>()) / w.head<3>().squaredNorm();
    return {-a, z[3] - a * w[3]};
}

}  // namespace

MuscleLayer::MuscleLayer(const Scene& scene, const Camera& camera, int picture_samples,
                         int width_samples, int height_samples)
    : vertex_count_(scene.muscles.rest.rows()),
      muscle_count_(scene.muscles.parts.size()),
      muscle_of_vertex_(static_cast<std::size_t>(vertex_count_), 0),
      surface_(scene.muscles.rest, muscle_triangles(scene)),
      distance_of_depth_(depth_terms(camera.clip_from_world)),
      right_(camera.clip_from_world.row(0).head<3>().normalized()),
      samples_per_slope_(0.5 * picture_samples * camera.clip_from_world.row(1).head<3>().norm()),
      program_("muscle", muscle_vertex_shader(), muscle_shader()) {
    std::vector<Face> faces;
    for (std::size_t m = 0; m < muscle_count_; ++m) {
        const Triangles& triangles = scene.muscles.parts[m].triangles;
        for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
            faces.push_back({triangles(f, 0), triangles(f, 1), triangles(f, 2)});
            for (const int v : faces.back())
                muscle_of_vertex_[static_cast<std::size_t>(v)] = static_cast<int>(m);
        }
    }
    order_for_drawing(scene.muscles.rest, camera.position, faces);
    std::vector<unsigned> indices;
    for (const Face& face : faces)
        for (const int v : face) indices.push_back(static_cast<unsigned>(v));
    index_count_ = static_cast<GLsizei>(indices.size());
    std::vector<float> fixed;
    for (Eigen::Index v = 0; v < vertex_count_; ++v) {
        fixed.push_back(static_cast<float>(scene.muscles.fibre(v, 0)));
        fixed.push_back(static_cast<float>(scene.muscles.fibre(v, 1)));
        fixed.push_back(static_cast<float>(scene.muscles.tendon[static_cast<std::size_t>(v)]));
    }

    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    for (GLuint* buffer : {&colour_buffer_, &fixed_buffer_, &elements_}) glGenBuffers(1, buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices.size() * sizeof(unsigned)), indices.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, fixed_buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(fixed.size() * sizeof(float)),
                 fixed.data(), GL_STATIC_DRAW);
    muscle_attribute(3);
    glBindBuffer(GL_ARRAY_BUFFER, colour_buffer_);
    muscle_attribute(2);
    surface_.attach();

    fibres_ = make_fibres();
    program_.use();
    glUniform2f(program_.location("fibre_tile"), static_cast<float>(kFibreTileAcross_m),
                static_cast<float>(kFibreTileAlong_m));
    colour_ = muscle_texture(GL_SRGB8_ALPHA8, width_samples, height_samples);
    depth_ = muscle_texture(GL_DEPTH_COMPONENT32F, width_samples, height_samples);
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw RunError("the OpenGL framebuffer of the muscles is incomplete");
}

MuscleLayer::~MuscleLayer() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &colour_);
    glDeleteTextures(1, &depth_);
    glDeleteTextures(1, &fibres_);
    for (const GLuint buffer : {colour_buffer_, fixed_buffer_, elements_})
        glDeleteBuffers(1, &buffer);
    glDeleteVertexArrays(1, &array_);
}

void MuscleLayer::upload(const Pose& pose) {
    surface_.upload(pose.muscle_positions, "pose/muscle_positions");
    if (pose.activations.size() != muscle_count_)
        throw Error("pose/activations", std::to_string(muscle_count_) + " values",
                    std::to_string(pose.activations.size()));
    std::vector<Vec3> colours;
    for (const double activation : pose.activations)
        colours.push_back(activation_colour(activation));
    colours_.clear();
    for (const int muscle : muscle_of_vertex_)
        for (const double channel : colours[static_cast<std::size_t>(muscle)])
            colours_.push_back(static_cast<float>(channel));
    glBindBuffer(GL_ARRAY_BUFFER, colour_buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(colours_.size() * sizeof(float)),
                 colours_.data(), GL_STREAM_DRAW);
}

void MuscleLayer::set_uniform(const GlProgram& program) const {
    glUniform2f(program.location("distance_of_depth"), static_cast<float>(distance_of_depth_.x()),
                static_cast<float>(distance_of_depth_.y()));
    const Eigen::Vector3f right = right_.cast<float>();
    glUniform3fv(program.location("right"), 1, right.data());
    glUniform1f(program.location("samples_per_slope"), static_cast<float>(samples_per_slope_));
}

void MuscleLayer::draw() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_FRAMEBUFFER_SRGB);
    program_.use();
    glActiveTexture(GL_TEXTURE0 + kFibreUnit);
    glBindTexture(GL_TEXTURE_2D, fibres_);
    glBindVertexArray(array_);
    glEnable(GL_CULL_FACE);
    glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
    glDisable(GL_CULL_FACE);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glActiveTexture(GL_TEXTURE0 + kMuscleColourUnit);
    glBindTexture(GL_TEXTURE_2D, colour_);
    glActiveTexture(GL_TEXTURE0 + kMuscleDepthUnit);
    glBindTexture(GL_TEXTURE_2D, depth_);
}

}  // namespace risorius::render
