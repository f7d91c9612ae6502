#include "render/detail/scene_buffers.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "render/detail/curvature.h"
#include "render/detail/face_order.h"
#include "render/detail/lash_strands.h"
#include "render/detail/shaders.h"
#include "render/detail/skin_paint.h"

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

// Skin first, as it hides most of the rest; what is blended last.
constexpr Material kDrawOrder[] = {Material::kSkin,   Material::kEye,    Material::kTeeth,
                                   Material::kTongue, Material::kGums,   Material::kMouth,
                                   Material::kMatte,  Material::kLashes, Material::kCornea};

void attribute(VertexAttribute index, GLint size, int floats_per_vertex, int offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(
        index, size, GL_FLOAT, GL_FALSE,
        static_cast<GLsizei>(static_cast<std::size_t>(floats_per_vertex) * sizeof(float)),
        reinterpret_cast<const void*>(static_cast<std::size_t>(offset) * sizeof(float)));
}

GLsizeiptr bytes(const std::vector<float>& values) {
    return static_cast<GLsizeiptr>(values.size() * sizeof(float));
}

}  // namespace

SceneBuffers::SceneBuffers(const Scene& scene, const Vec3& camera, const Vec3& paint_centre)
    : smooth_(scene.rest, triangle_lists(scene)) {
    // Batches: near triangles first, so that hidden ones fail the depth test before they are shaded.
    for (const Material material : kDrawOrder)
        for (const int eye : {-1, 0, 1})
            for (int texture = -1; texture < static_cast<int>(scene.textures.size()); ++texture)
                add_batch(scene, material, eye, texture, camera, paint_centre);
    index_count_ = static_cast<int>(indices_.size());

    const auto vertices = static_cast<std::size_t>(scene.rest.rows());
    lashes_ = lash_places(scene);
    std::vector<float> fixed;
    for (std::size_t v = 0; v < vertices; ++v) {
        const Vec3 p = scene.rest.row(static_cast<Eigen::Index>(v)).transpose();
        const Vec2 place = paint_place(p, paint_centre);
        for (int k = 0; k < 3; ++k) fixed.push_back(static_cast<float>(p[k]));
        for (int k = 0; k < 2; ++k) paint_.push_back(static_cast<float>(place[k]));
        fixed.push_back(lashes_[v].is_lash ? lashes_[v].along_m : static_cast<float>(place.x()));
        fixed.push_back(lashes_[v].is_lash ? lashes_[v].share : static_cast<float>(place.y()));
    }

    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    for (GLuint* buffer :
         {&moving_buffer_, &fixed_buffer_, &occlusion_buffer_, &colour_buffer_, &elements_})
        glGenBuffers(1, buffer);
    glGenBuffers(2, chosen_elements_.data());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices_.size() * sizeof(unsigned)), indices_.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, fixed_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(fixed), fixed.data(), GL_STATIC_DRAW);
    attribute(kRest, 3, 5, 0);
    attribute(kPaintPlace, 2, 5, 3);
    curvature_ = curvature(scene.rest, indices_);
    set_occlusion(std::vector<float>(vertices, 1.0F), std::vector<float>(vertices, 0.0F));
    attribute(kOcclusion, 3, 3, 0);
    if (scene.fold_phase.rows() > 0) {
        std::vector<float> phase(3 * vertices, 0.0F);
        for (std::size_t i = 0; i < phase.size(); ++i)
            phase[i] = static_cast<float>(scene.fold_phase.data()[i]);
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

void SceneBuffers::add_batch(const Scene& scene, Material material, int eye, int texture,
                             const Vec3& camera, const Vec3& paint_centre) {
    std::vector<Face> faces;
    const bool of_eye = material == Material::kEye || material == Material::kCornea;
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != material || (of_eye ? std::max(surface.eye, 0) : -1) != eye ||
            (material == Material::kSkin ? -1 : surface.texture) != texture)
            continue;
        for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
            faces.push_back(
                {surface.triangles(f, 0), surface.triangles(f, 1), surface.triangles(f, 2)});
    }
    if (faces.empty()) return;
    bool cull = false;
    if (material == Material::kSkin) {
        cull = is_wound_outwards(scene.rest, faces, paint_centre);
    } else if (material == Material::kEye || material == Material::kTeeth) {
        wind_outwards(scene.rest, faces);
        cull = true;
    }
    order_for_drawing(scene.rest, camera, faces);
    batches_.push_back({material, eye, texture, static_cast<int>(indices_.size()),
                        static_cast<int>(3 * faces.size()), cull});
    for (const Face& face : faces)
        for (const int v : face) indices_.push_back(static_cast<unsigned>(v));
}

SceneBuffers::~SceneBuffers() {
    const GLuint buffers[] = {moving_buffer_, fixed_buffer_,      occlusion_buffer_, colour_buffer_,
                              elements_,      fold_phase_buffer_, fold_depth_buffer_};
    glDeleteBuffers(7, buffers);
    glDeleteBuffers(2, chosen_elements_.data());
    glDeleteVertexArrays(1, &array_);
}

void SceneBuffers::upload(const Points& positions, const Points& fold_depth) {
    const auto vertices = static_cast<std::size_t>(positions.rows());
    positions_.resize(3 * vertices);
    for (std::size_t i = 0; i < positions_.size(); ++i)
        positions_[i] = static_cast<float>(positions.data()[i]);
    smooth_.compute(positions_, normals_);
    moving_.resize(6 * vertices);
    for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t k = 0; k < 3; ++k) {
            moving_[6 * v + k] = positions_[3 * v + k];
            moving_[6 * v + 3 + k] = normals_[3 * v + k];
        }
    if (fold_depth_buffer_ != 0) {
        fold_depth_.assign(3 * vertices, 0.0F);
        if (fold_depth.rows() > 0)
            for (std::size_t i = 0; i < fold_depth_.size(); ++i)
                fold_depth_[i] = static_cast<float>(fold_depth.data()[i]);
        wrinkled_.resize(vertices);
        for (std::size_t v = 0; v < vertices; ++v)
            wrinkled_[v] =
                fold_depth_[3 * v] > 0 || fold_depth_[3 * v + 1] > 0 || fold_depth_[3 * v + 2] > 0;
        glBindBuffer(GL_ARRAY_BUFFER, fold_depth_buffer_);
        glBufferData(GL_ARRAY_BUFFER, bytes(fold_depth_), fold_depth_.data(), GL_STREAM_DRAW);
    }
    glBindBuffer(GL_ARRAY_BUFFER, moving_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(moving_), moving_.data(), GL_STREAM_DRAW);
}

void SceneBuffers::set_colours(const std::vector<float>& rgb) {
    glBindBuffer(GL_ARRAY_BUFFER, colour_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(rgb), rgb.data(), GL_STREAM_DRAW);
    attribute(kColour, 3, 3, 0);
}

void SceneBuffers::set_occlusion(const std::vector<float>& sky_seen,
                                 const std::vector<float>& inside_mouth) {
    occlusion_.resize(3 * sky_seen.size());
    for (std::size_t v = 0; v < sky_seen.size(); ++v) {
        occlusion_[3 * v] = lashes_[v].is_lash ? (lashes_[v].lower_lid ? 1.0F : 0.0F) : sky_seen[v];
        occlusion_[3 * v + 1] = inside_mouth[v];
        occlusion_[3 * v + 2] = curvature_[v];
    }
    glBindBuffer(GL_ARRAY_BUFFER, occlusion_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(occlusion_), occlusion_.data(), GL_STREAM_DRAW);
}

int SceneBuffers::skin_index_count() const {
    return batches_.front().material == Material::kSkin ? batches_.front().index_count : 0;
}

void SceneBuffers::choose(const Eigen::Matrix4f& clip_from_world, Purpose purpose) {
    const std::size_t vertices = positions_.size() / 3;
    clip_places_.resize(4 * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const Eigen::Vector4f clip =
            clip_from_world *
            Eigen::Vector4f(positions_[3 * v], positions_[3 * v + 1], positions_[3 * v + 2], 1.0F);
        clip_places_[4 * v] = clip.x() / clip.w();
        clip_places_[4 * v + 1] = clip.y() / clip.w();
        clip_places_[4 * v + 2] = clip.z() / clip.w();
        clip_places_[4 * v + 3] = clip.w();
    }
    const auto is_seen = [&](const unsigned* face, bool cull_back) {
        const float *a = clip_places_.data() + 4 * static_cast<std::size_t>(face[0]),
                    *b = clip_places_.data() + 4 * static_cast<std::size_t>(face[1]),
                    *c = clip_places_.data() + 4 * static_cast<std::size_t>(face[2]);
        if (a[3] <= 0 || b[3] <= 0 || c[3] <= 0) return true;
        for (std::size_t k = 0; k < 2; ++k)
            if ((a[k] < -1 && b[k] < -1 && c[k] < -1) || (a[k] > 1 && b[k] > 1 && c[k] > 1))
                return false;
        // A thousandth of a pixel of any picture is left to the rasteriser to judge.
        constexpr float kRounding = 1e-10F;
        return !cull_back ||
               (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]) > -kRounding;
    };
    choice_.clear();
    std::vector<Chosen>& chosen = chosen_[purpose];
    chosen.assign(batches_.size(), {});
    for (std::size_t i = 0; i < batches_.size(); ++i) {
        const Batch& batch = batches_[i];
        chosen[i].first = static_cast<int>(choice_.size());
        if (purpose == kShadow && batch.material != Material::kSkin) continue;
        const bool apart =
            purpose == kSeen && batch.material == Material::kSkin && !wrinkled_.empty();
        wrinkled_choice_.clear();
        for (int k = 0; k < batch.index_count; k += 3) {
            const unsigned* face = indices_.data() + batch.first_index + k;
            // What has a texture is looked up by the number of its triangle.
            // Light that has come in at the mouth does not go out at the back of the head.
            if (batch.texture < 0 && !is_seen(face, batch.cull_back && purpose == kSeen)) continue;
            const bool wrinkled =
                apart && (wrinkled_[face[0]] || wrinkled_[face[1]] || wrinkled_[face[2]]);
            std::vector<unsigned>& to = wrinkled ? wrinkled_choice_ : choice_;
            to.insert(to.end(), face, face + 3);
        }
        chosen[i].smooth = static_cast<int>(choice_.size()) - chosen[i].first;
        chosen[i].wrinkled = static_cast<int>(wrinkled_choice_.size());
        choice_.insert(choice_.end(), wrinkled_choice_.begin(), wrinkled_choice_.end());
    }
    upload_choice(purpose);
}

void SceneBuffers::leave_out_hidden(const FarthestSkin& skin) {
    const auto is_hidden = [&](const unsigned* face) {
        float left = 1e9F, right = -1e9F, low = 1e9F, high = -1e9F, near = 1e9F;
        for (int k = 0; k < 3; ++k) {
            const float* p = clip_places_.data() + 4 * static_cast<std::size_t>(face[k]);
            if (p[3] <= 0) return false;
            const float x = (0.5F * p[0] + 0.5F) * skin.width,
                        y = (0.5F * p[1] + 0.5F) * skin.height;
            left = std::min(left, x);
            right = std::max(right, x);
            low = std::min(low, y);
            high = std::max(high, y);
            near = std::min(near, 0.5F * p[2] + 0.5F);
        }
        // A pixel more on each side: samples lie beside the middle of theirs.
        constexpr float kPixel = 1.0F / FarthestSkin::kCell;
        const int from_x = std::max(static_cast<int>(left - kPixel), 0),
                  to_x = std::min(static_cast<int>(right + kPixel), skin.columns - 1),
                  from_y = std::max(static_cast<int>(low - kPixel), 0),
                  to_y = std::min(static_cast<int>(high + kPixel), skin.rows - 1);
        for (int y = from_y; y <= to_y; ++y)
            for (int x = from_x; x <= to_x; ++x)
                if (near <= skin.depth[static_cast<std::size_t>(y * skin.columns + x)])
                    return false;
        return true;
    };
    std::size_t kept = 0;
    for (std::size_t i = 0; i < batches_.size(); ++i) {
        Chosen& chosen = chosen_[kSeen][i];
        const Material material = batches_[i].material;
        const bool may_hide = batches_[i].texture < 0 &&
                              (material == Material::kEye || material == Material::kTeeth ||
                               material == Material::kGums || material == Material::kTongue);
        const auto from = static_cast<std::size_t>(chosen.first);
        const std::size_t end = from + static_cast<std::size_t>(chosen.smooth + chosen.wrinkled);
        chosen.first = static_cast<int>(kept);
        for (std::size_t k = from; k < end; k += 3) {
            if (may_hide && is_hidden(choice_.data() + k)) {
                chosen.smooth -= 3;
                continue;
            }
            std::copy_n(choice_.begin() + static_cast<std::ptrdiff_t>(k), 3,
                        choice_.begin() + static_cast<std::ptrdiff_t>(kept));
            kept += 3;
        }
    }
    choice_.resize(kept);
    upload_choice(kSeen);
}

void SceneBuffers::upload_choice(Purpose purpose) {
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, chosen_elements_[purpose]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(choice_.size() * sizeof(unsigned)), choice_.data(),
                 GL_STREAM_DRAW);
}

void SceneBuffers::draw(const Batch& batch, Purpose purpose, int first, int count) const {
    if (count == 0) return;
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, chosen_elements_[purpose]);
    if (batch.cull_back && purpose == kSeen) glEnable(GL_CULL_FACE);
    glDrawElements(
        GL_TRIANGLES, count, GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(static_cast<std::size_t>(first) * sizeof(unsigned)));
    glDisable(GL_CULL_FACE);
}

void SceneBuffers::draw(const Batch& batch, Purpose purpose) const {
    const Chosen& chosen = chosen_of(batch, purpose);
    draw(batch, purpose, chosen.first, chosen.smooth + chosen.wrinkled);
}

void SceneBuffers::draw_smooth(const Batch& batch) const {
    const Chosen& chosen = chosen_of(batch);
    draw(batch, kSeen, chosen.first, chosen.smooth);
}

void SceneBuffers::draw_wrinkled(const Batch& batch) const {
    const Chosen& chosen = chosen_of(batch);
    draw(batch, kSeen, chosen.first + chosen.smooth, chosen.wrinkled);
}

std::vector<unsigned> SceneBuffers::paintable_triangles(
    const std::vector<float>& inside_mouth) const {
    // Around the back of the head a triangle may span the whole rim of the map.
    constexpr float kWidest = 0.15F;
    std::vector<unsigned> triangles;
    for (std::size_t i = 0; i < static_cast<std::size_t>(skin_index_count()); i += 3) {
        const bool hidden = inside_mouth[indices_[i]] > 0.5F &&
                            inside_mouth[indices_[i + 1]] > 0.5F &&
                            inside_mouth[indices_[i + 2]] > 0.5F;
        float widest = 0;
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t k = 0; k < 2; ++k)
                widest = std::max(widest, std::abs(paint_[2 * indices_[i + a] + k] -
                                                   paint_[2 * indices_[i + (a + 1) % 3] + k]));
        if (!hidden && widest < kWidest)
            triangles.insert(triangles.end(), {indices_[i], indices_[i + 1], indices_[i + 2]});
    }
    return triangles;
}

}  // namespace risorius::render
