// SPDX-License-Identifier: MIT
#include "risorius/render/detail/scene_buffers.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "risorius/core/error.h"
#include "risorius/render/detail/curvature.h"
#include "risorius/render/detail/lash_strands.h"
#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

std::vector<const Triangles*> triangle_lists(const Scene& scene) {
    std::vector<const Triangles*> lists;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Triangles& triangles = scene.surfaces[i].triangles;
        if (triangles.size() > 0 &&
            (triangles.minCoeff() < 0 || triangles.maxCoeff() >= scene.rest.rows()))
            throw Error(
                "scene/surfaces/" + std::to_string(i) + "/triangles",
                "vertices 0.." + std::to_string(scene.rest.rows() - 1),
                std::to_string(triangles.minCoeff()) + ".." + std::to_string(triangles.maxCoeff()));
        lists.push_back(&triangles);
    }
    return lists;
}

void attribute(VertexAttribute index, GLint size, int floats_per_vertex, int offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(
        index, size, GL_FLOAT, GL_FALSE,
        static_cast<GLsizei>(static_cast<std::size_t>(floats_per_vertex) * sizeof(float)),
        reinterpret_cast<const void*>(static_cast<std::size_t>(offset) * sizeof(float)));
}

/// How strongly a vertex shows its pores. They fade where the skin faces away from the middle of the head, because the map is
/// stretched there, and towards the back of the head.
std::vector<float> pores_shown(const Points& rest, const std::vector<float>& normals,
                               const Vec3& paint_centre) {
    const auto smooth = [](double from, double to, double at) {
        const double t = std::clamp((at - from) / (to - from), 0.0, 1.0);
        return t * t * (3 - 2 * t);
    };
    std::vector<float> shown;
    for (long v = 0; v < rest.rows(); ++v) {
        const Vec3 p = rest.row(v).transpose();
        const float* n = normals.data() + 3 * v;
        const double facing = Vec3(n[0], n[1], n[2]).dot((p - paint_centre).normalized());
        const double aside = (paint_place(p, paint_centre) - Vec2(0.5, 0.5)).norm();
        shown.push_back(static_cast<float>(smooth(0.3, 0.75, facing) * smooth(0.37, 0.28, aside)));
    }
    return shown;
}

GLsizeiptr bytes(const std::vector<float>& values) {
    return static_cast<GLsizeiptr>(values.size() * sizeof(float));
}

}  // namespace

SceneBuffers::SceneBuffers(const Scene& scene, const Vec3& camera, const Vec3& paint_centre,
                           const Coarseness& coarseness)
    : smooth_(scene.rest, triangle_lists(scene)),
      triangles_(scene, camera, paint_centre, coarseness) {
    // The driver caches shaded vertices for a few hundred triangles, but only if the numbers of their vertices are close
    // together.
    const auto vertices = static_cast<std::size_t>(scene.rest.rows());
    constexpr unsigned kNone = ~0U;
    unsigned used = 0;
    number_.assign(vertices, kNone);
    for (const auto* some : {&triangles_.coarse_skin(Purpose::kSeen), &triangles_.indices()})
        for (const unsigned v : *some)
            if (number_[v] == kNone) number_[v] = used++;
    for (unsigned& number : number_)
        if (number == kNone) number = used++;

    lashes_ = lash_places(scene);
    std::vector<float> fixed(5 * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const Vec3 p = scene.rest.row(static_cast<Eigen::Index>(v)).transpose();
        const Vec2 place = paint_place(p, paint_centre);
        for (int k = 0; k < 2; ++k) paint_.push_back(static_cast<float>(place[k]));
        float* to = fixed.data() + 5 * static_cast<std::size_t>(number_[v]);
        for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(p[k]);
        to[3] = lashes_[v].is_lash ? lashes_[v].along_m : static_cast<float>(place.x());
        to[4] = lashes_[v].is_lash ? lashes_[v].fraction : static_cast<float>(place.y());
    }

    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    for (GLuint* buffer :
         {&moving_buffer_, &fixed_buffer_, &occlusion_buffer_, &colour_buffer_, &elements_})
        glGenBuffers(1, buffer);
    glGenBuffers(2, chosen_elements_.data());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    const std::vector<unsigned> all = elements(indices());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(all.size() * sizeof(unsigned)),
                 all.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, fixed_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(fixed), fixed.data(), GL_STATIC_DRAW);
    attribute(kRest, 3, 5, 0);
    attribute(kPaintPlace, 2, 5, 3);
    curvature_ = curvature(scene.rest, indices());
    place(scene.rest);
    pores_ = pores_shown(scene.rest, normals_, paint_centre);
    set_occlusion(std::vector<float>(vertices, 1.0F), std::vector<float>(vertices, 0.0F));
    attribute(kOcclusion, 4, 4, 0);
    if (scene.fold_phase.rows() > 0) {
        std::vector<float> phase(3 * vertices, 0.0F);
        for (std::size_t v = 0; v < vertices; ++v)
            for (std::size_t k = 0; k < 3; ++k)
                phase[3 * number_[v] + k] = static_cast<float>(scene.fold_phase.data()[3 * v + k]);
        glGenBuffers(1, &fold_phase_buffer_);
        glBindBuffer(GL_ARRAY_BUFFER, fold_phase_buffer_);
        glBufferData(GL_ARRAY_BUFFER, bytes(phase), phase.data(), GL_STATIC_DRAW);
        attribute(kFoldPhase, 3, 3, 0);
        glGenBuffers(1, &fold_depth_buffer_);
        glBindBuffer(GL_ARRAY_BUFFER, fold_depth_buffer_);
        attribute(kFoldDepth, 3, 3, 0);
    }
    upload(scene.rest);
    attribute(kPosition, 3, 6, 0);
    attribute(kNormal, 3, 6, 3);
}

SceneBuffers::~SceneBuffers() {
    const GLuint buffers[] = {moving_buffer_, fixed_buffer_,      occlusion_buffer_, colour_buffer_,
                              elements_,      fold_phase_buffer_, fold_depth_buffer_};
    glDeleteBuffers(7, buffers);
    glDeleteBuffers(2, chosen_elements_.data());
    glDeleteVertexArrays(1, &array_);
}

void SceneBuffers::place(const Points& positions) {
    positions_.resize(static_cast<std::size_t>(positions.size()));
    for (std::size_t i = 0; i < positions_.size(); ++i)
        positions_[i] = static_cast<float>(positions.data()[i]);
    choice_.moved();
    smooth_.compute(positions_, normals_);
}

void SceneBuffers::upload(const Points& positions, const Points& fold_depth) {
    const auto vertices = static_cast<std::size_t>(positions.rows());
    place(positions);
    moving_.resize(6 * vertices);
    for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t k = 0; k < 3; ++k) {
            moving_[6 * number_[v] + k] = positions_[3 * v + k];
            moving_[6 * number_[v] + 3 + k] = normals_[3 * v + k];
        }
    if (fold_depth_buffer_ != 0) {
        fold_depth_.assign(3 * vertices, 0.0F);
        wrinkled_.assign(vertices, 0);
        if (fold_depth.rows() > 0)
            for (std::size_t v = 0; v < vertices; ++v)
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto depth = static_cast<float>(fold_depth.data()[3 * v + k]);
                    fold_depth_[3 * number_[v] + k] = depth;
                    if (depth > 0) wrinkled_[v] = 1;
                }
        glBindBuffer(GL_ARRAY_BUFFER, fold_depth_buffer_);
        glBufferData(GL_ARRAY_BUFFER, bytes(fold_depth_), fold_depth_.data(), GL_STREAM_DRAW);
    }
    glBindBuffer(GL_ARRAY_BUFFER, moving_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(moving_), moving_.data(), GL_STREAM_DRAW);
}

void SceneBuffers::set_colours(const std::vector<float>& rgb) {
    std::vector<float> numbered(rgb.size());
    for (std::size_t v = 0; v < rgb.size() / 3; ++v)
        std::copy_n(rgb.begin() + static_cast<std::ptrdiff_t>(3 * v), 3,
                    numbered.begin() + 3 * static_cast<std::ptrdiff_t>(number_[v]));
    glBindBuffer(GL_ARRAY_BUFFER, colour_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(numbered), numbered.data(), GL_STREAM_DRAW);
    attribute(kColour, 3, 3, 0);
}

void SceneBuffers::set_occlusion(const std::vector<float>& sky_seen,
                                 const std::vector<float>& inside_mouth) {
    occlusion_.resize(4 * sky_seen.size());
    for (std::size_t v = 0; v < sky_seen.size(); ++v) {
        float* to = occlusion_.data() + 4 * static_cast<std::size_t>(number_[v]);
        to[0] = lashes_[v].is_lash ? (lashes_[v].lower_lid ? 1.0F : 0.0F) : sky_seen[v];
        to[1] = inside_mouth[v];
        to[2] = curvature_[v];
        to[3] = pores_[v];
    }
    glBindBuffer(GL_ARRAY_BUFFER, occlusion_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(occlusion_), occlusion_.data(), GL_STREAM_DRAW);
}

void SceneBuffers::choose(const Eigen::Matrix4f& clip_from_world, bool whole) {
    choice_.choose(clip_from_world, whole);
    upload_choice(Purpose::kSeen);
}

void SceneBuffers::choose_casters(const Eigen::Matrix4f& light_from_world,
                                  const Eigen::Matrix4f* clip_from_world) {
    choice_.choose_casters(light_from_world, clip_from_world);
    upload_choice(Purpose::kShadow);
}

void SceneBuffers::leave_out_unseen(SkinLayer& skin, PictureCells& cells,
                                    const std::function<void(PictureCells&)>& mark_others) {
    choice_.leave_out_unseen(skin, cells, mark_others);
    upload_choice(Purpose::kSeen);
}

void SceneBuffers::upload_choice(Purpose purpose) {
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, chosen_elements_[static_cast<std::size_t>(purpose)]);
    const std::vector<unsigned> numbers = elements(choice_.corners());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(numbers.size() * sizeof(unsigned)), numbers.data(),
                 GL_STREAM_DRAW);
}

std::vector<unsigned> SceneBuffers::elements(const std::vector<unsigned>& vertices) const {
    std::vector<unsigned> numbers;
    numbers.reserve(vertices.size());
    for (const unsigned v : vertices) numbers.push_back(number_[v]);
    return numbers;
}

void SceneBuffers::draw(const Batch& batch, Purpose purpose, int first, int count) const {
    if (count == 0) return;
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, chosen_elements_[static_cast<std::size_t>(purpose)]);
    if (batch.cull_back && purpose == Purpose::kSeen) glEnable(GL_CULL_FACE);
    glDrawElements(
        GL_TRIANGLES, count, GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(static_cast<std::size_t>(first) * sizeof(unsigned)));
    glDisable(GL_CULL_FACE);
}

void SceneBuffers::draw(const Batch& batch, Purpose purpose) const {
    const TriangleChoice::Range& chosen = choice_.range(batch, purpose);
    draw(batch, purpose, chosen.first, chosen.smooth + chosen.wrinkled);
}

void SceneBuffers::draw_smooth(const Batch& batch) const {
    const TriangleChoice::Range& chosen = choice_.range(batch, Purpose::kSeen);
    draw(batch, Purpose::kSeen, chosen.first, chosen.smooth);
}

void SceneBuffers::draw_wrinkled(const Batch& batch) const {
    const TriangleChoice::Range& chosen = choice_.range(batch, Purpose::kSeen);
    draw(batch, Purpose::kSeen, chosen.first + chosen.smooth, chosen.wrinkled);
}

std::vector<unsigned> SceneBuffers::paintable_triangles(
    const std::vector<float>& inside_mouth) const {
    // Around the back of the head a triangle may span the whole rim of the map.
    constexpr float kWidest = 0.15F;
    const std::vector<unsigned>& corner = indices();
    std::vector<unsigned> triangles;
    for (std::size_t i = 0; i < static_cast<std::size_t>(skin_index_count()); i += 3) {
        const bool hidden = inside_mouth[corner[i]] > 0.5F && inside_mouth[corner[i + 1]] > 0.5F &&
                            inside_mouth[corner[i + 2]] > 0.5F;
        float widest = 0;
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t k = 0; k < 2; ++k)
                widest = std::max(widest, std::abs(paint_[2 * corner[i + a] + k] -
                                                   paint_[2 * corner[i + (a + 1) % 3] + k]));
        if (!hidden && widest < kWidest)
            triangles.insert(triangles.end(), {corner[i], corner[i + 1], corner[i + 2]});
    }
    return triangles;
}

}  // namespace risorius::render
