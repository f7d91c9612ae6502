// SPDX-License-Identifier: MIT
#include "risorius/render/detail/lock_layer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "risorius/core/counter_rng.h"
#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/detail/skin_plan.h"
#include "risorius/render/detail/strand_texture.h"

namespace risorius::render {
namespace {

constexpr int kLockFloats = 16;
/// A lock faces away where the cosine of its outside and the way to the camera is below this
constexpr double kTurnedAway = -0.25;

/// Whether some of its surroundings are left out as gaps between hairs.
bool is_thin(const HairVertex& v) { return v.across != 0 || v.open > 0; }

ShaderConstants with_tones(const Appearance& appearance, ShaderConstants constants) {
    constants.set("hair_tone", linear_from_srgb(appearance.hair_tone));
    constants.set("white_tone", linear_from_srgb(kWhiteHair));
    // Combed locks that lie over and under each other would shade each other in patches.
    const LockStyle* style = lock_style(appearance.hair_style);
    constants.set("own_shadow", style && style->flow == HairFlow::kParting ? 0.014 : 0.004);
    // Tight curls mirror in all directions.
    constants.set("mirrors", style && style->flow == HairFlow::kRadial ? 0.4 : 1.0);
    constants.set("has_white", white_share(appearance) > 0);
    return constants;
}

}  // namespace

LockLayer::LockLayer(const Scene& scene, Hair hair, const Camera& camera,
                     const ShaderConstants& constants, bool layer)
    : hair_(std::move(hair)),
      rest_(scene.rest),
      camera_(camera.eye_point()),
      program_("locks", with_tones(scene.appearance, constants).in(lock_vertex_shader()),
               with_tones(scene.appearance, constants).in(lock_shader(layer, false))),
      thin_program_("thin locks", with_tones(scene.appearance, constants).in(lock_vertex_shader()),
                    with_tones(scene.appearance, constants).in(lock_shader(layer, true))) {
    if (empty()) return;
    GLint outer = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &outer);
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    for (GLuint* buffer : {&buffer_, &elements_, &casters_, &sampled_}) glGenBuffers(1, buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, casters_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(hair_.casters.size() * sizeof(unsigned)),
                 hair_.casters.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    GLuint location = 0;
    std::size_t offset = 0;
    for (const int size :
         {3, 3, 3, 2, 3, 2}) {  // position, along, out, strand, light-tone-grey, thin
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location++, size, GL_FLOAT, GL_FALSE, kLockFloats * sizeof(float),
                              reinterpret_cast<const void*>(offset * sizeof(float)));
        offset += static_cast<std::size_t>(size);
    }
    glBindVertexArray(static_cast<GLuint>(outer));
    strands_ = make_strand_texture(scene.appearance.seed, white_share(scene.appearance));
}

LockLayer::~LockLayer() {
    const GLuint buffers[] = {buffer_, elements_, casters_, sampled_};
    glDeleteBuffers(4, buffers);
    glDeleteVertexArrays(1, &array_);
    glDeleteTextures(1, &strands_);
}

void LockLayer::upload(const Pose& pose) {
    if (empty()) return;
    const PosedHair posed = pose_hair(hair_, rest_, pose.positions);
    vertices_.clear();
    for (std::size_t i = 0; i < hair_.vertices.size(); ++i) {
        const HairVertex& v = hair_.vertices[i];
        const Vec3 p = posed.positions.row(static_cast<Eigen::Index>(i)).transpose(),
                   along = posed.turned * v.along, out = posed.turned * v.out;
        for (const Vec3* three : {&p, &along, &out})
            for (int k = 0; k < 3; ++k) vertices_.push_back(static_cast<float>((*three)[k]));
        for (const double one :
             {v.strand.x(), v.strand.y(), v.lit, v.tone, v.grey, v.across, v.open})
            vertices_.push_back(static_cast<float>(one));
    }
    choose(posed);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(float)),
                 vertices_.data(), GL_STREAM_DRAW);
    GLint outer = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &outer);
    glBindVertexArray(array_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(chosen_.size() * sizeof(unsigned)), chosen_.data(),
                 GL_STREAM_DRAW);
    glBindVertexArray(static_cast<GLuint>(outer));
}

void LockLayer::choose(const PosedHair& posed) {
    // A vertex is left out where its outside faces away; where hair hangs free, if the head is in front of it.
    struct Ball {
        Vec3 centre;
        double radius_m;
    };
    const std::array<Ball, 2> balls{Ball{posed.in_head(Vec3(0, 0.045, 0)), 0.066},
                                    Ball{posed.in_head(Vec3(0, -0.045, 0.005)), 0.050}};
    const auto behind_head = [&](const Vec3& p) {
        for (const Ball& ball : balls) {
            const Vec3 way = (p - camera_).normalized();
            const double along = way.dot(ball.centre - camera_);
            if (along < (p - camera_).norm() &&
                (camera_ + along * way - ball.centre).norm() < ball.radius_m)
                return true;
        }
        return false;
    };
    chosen_.clear();
    whole_.clear();
    std::vector<bool> seen;
    for (const HairPiece& piece : hair_.pieces) {
        seen.assign(piece.vertices, true);
        for (std::size_t i = 0; i < piece.vertices; ++i) {
            const std::size_t v = piece.first_vertex + i;
            const Vec3 p = posed.positions.row(static_cast<Eigen::Index>(v)).transpose(),
                       to = camera_ - p;
            const bool away =
                (posed.turned * hair_.vertices[v].out).dot(to) < kTurnedAway * to.norm();
            seen[i] = !away || (!piece.turns_away && !behind_head(p));
        }
        for (std::size_t i = 0; i < piece.indices; i += 3) {
            const unsigned* corner = hair_.triangles.data() + piece.first_index + i;
            if (seen[corner[0] - piece.first_vertex] || seen[corner[1] - piece.first_vertex] ||
                seen[corner[2] - piece.first_vertex]) {
                const bool thin = is_thin(hair_.vertices[corner[0]]) ||
                                  is_thin(hair_.vertices[corner[1]]) ||
                                  is_thin(hair_.vertices[corner[2]]);
                std::vector<unsigned>& into = thin ? chosen_ : whole_;
                into.insert(into.end(), corner, corner + 3);
            }
        }
    }
    thin_ = chosen_.size();
    chosen_.insert(chosen_.end(), whole_.begin(), whole_.end());
}

void LockLayer::draw_casters() const {
    if (empty()) return;
    glBindVertexArray(array_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, casters_);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(hair_.casters.size()), GL_UNSIGNED_INT,
                   nullptr);
}

void LockLayer::draw() const {
    if (empty()) return;
    glActiveTexture(GL_TEXTURE0 + kStrandUnit);
    glBindTexture(GL_TEXTURE_2D, strands_);
    glBindVertexArray(array_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    thin_program_.use();
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(thin_), GL_UNSIGNED_INT, nullptr);
    // Without gaps, depth is tested before the shader: what these hide costs nothing.
    program_.use();
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(chosen_.size() - thin_), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(thin_ * sizeof(unsigned)));
}

void LockLayer::touch(const Eigen::Matrix4f& clip_from_world, PictureCells& cells) {
    std::vector<Eigen::Vector3f> places;
    places.reserve(vertices_.size() / kLockFloats);
    for (std::size_t i = 0; i < vertices_.size(); i += kLockFloats) {
        const Eigen::Vector4f clip =
            clip_from_world *
            Eigen::Vector4f(vertices_[i], vertices_[i + 1], vertices_[i + 2], 1.0F);
        places.emplace_back(clip.x() / clip.w(), clip.y() / clip.w(), clip.w());
    }
    boxes_.clear();
    for (std::size_t i = 0; i + 2 < chosen_.size(); i += 3) {
        ClipBox box;
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::Vector3f& at = places[chosen_[i + k]];
            box.add(at.x(), at.y(), at.z());
        }
        cells.touch_hair(box);
        boxes_.push_back(box);
    }
}

void LockLayer::look_up(const PictureCells& cells) {
    if (empty()) return;
    std::vector<unsigned> sampled;
    for (std::size_t i = 0; i < boxes_.size(); ++i)
        if (cells.needs_samples(boxes_[i]))
            sampled.insert(sampled.end(), chosen_.begin() + static_cast<std::ptrdiff_t>(3 * i),
                           chosen_.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    glBindVertexArray(array_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, sampled_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(sampled.size() * sizeof(unsigned)), sampled.data(),
                 GL_STREAM_DRAW);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(sampled.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace risorius::render
