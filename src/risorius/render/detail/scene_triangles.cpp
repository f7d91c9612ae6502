// SPDX-License-Identifier: MIT
#include "risorius/render/detail/scene_triangles.h"

#include <algorithm>

#include "risorius/render/detail/face_order.h"

namespace risorius::render {
namespace {

// The skin comes first because it hides most of the rest. Blended materials come last.
constexpr Material kDrawOrder[] = {Material::kSkin,   Material::kEye,    Material::kTeeth,
                                   Material::kTongue, Material::kGums,   Material::kMouth,
                                   Material::kMatte,  Material::kLashes, Material::kCornea};

}  // namespace

SceneTriangles::SceneTriangles(const Scene& scene, const Vec3& camera, const Vec3& paint_centre,
                               const Coarseness& coarseness) {
    // Near triangles come first in each batch, so that hidden ones fail the depth test before they are shaded.
    for (const Material material : kDrawOrder)
        for (const int eye : {-1, 0, 1})
            for (int texture = -1; texture < static_cast<int>(scene.textures.size()); ++texture)
                add_batch(scene, material, eye, texture, camera, paint_centre, coarseness);
}

void SceneTriangles::add_batch(const Scene& scene, Material material, int eye, int texture,
                               const Vec3& camera, const Vec3& paint_centre,
                               const Coarseness& coarseness) {
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
    // Where poses bend the skin, a second simplification with a smaller error is used. Wrinkled skin is not simplified.
    const std::function<bool(const Face&)> bent = much_moved(scene),
                                           folds = may_fold(scene, coarseness.keeps_folds);
    const auto stays_when_moved = [&](const Face& face) { return !bent(face) || folds(face); };
    const auto coarse = [&](double error_m, const std::function<bool(const Face&)>& stays) {
        std::vector<unsigned> corners;
        if (error_m <= 0) return corners;
        std::vector<Face> fewer = coarser_faces(scene.rest, faces, error_m, stays);
        if (material == Material::kSkin)
            fewer = coarser_faces(scene.rest, fewer, coarseness.moved_m, stays_when_moved);
        order_for_drawing(scene.rest, camera, fewer);
        for (const Face& face : fewer)
            for (const int v : face) corners.push_back(static_cast<unsigned>(v));
        return corners;
    };
    if (material == Material::kSkin) {
        cull = is_wound_outwards(scene.rest, faces, paint_centre);
        const auto moved = [&](const Face& face) { return bent(face) || folds(face); };
        coarse_skin_ = {coarse(coarseness.seen_m, moved), coarse(coarseness.shadow_m, bent)};
    } else if (material == Material::kEye || material == Material::kTeeth) {
        wind_outwards(scene.rest, faces);
        cull = true;
    }
    // An eye is rigid, so all of it may be simplified. A textured eye is not simplified, because its texture coordinates are
    // looked up by triangle number.
    coarse_eyes_.push_back(of_eye && texture < 0
                               ? coarse(coarseness.eyes_m, [](const Face&) { return false; })
                               : std::vector<unsigned>());
    order_for_drawing(scene.rest, camera, faces);
    batches_.push_back({material, eye, texture, static_cast<int>(indices_.size()),
                        static_cast<int>(3 * faces.size()), cull});
    for (const Face& face : faces)
        for (const int v : face) indices_.push_back(static_cast<unsigned>(v));
}

std::span<const unsigned> SceneTriangles::corners_of(const Batch& batch, Purpose purpose,
                                                     bool whole) const {
    const std::vector<unsigned>& coarse =
        batch.material == Material::kSkin
            ? coarse_skin(purpose)
            : coarse_eyes_[static_cast<std::size_t>(&batch - batches_.data())];
    if (!coarse.empty() && !whole) return coarse;
    return std::span(indices_).subspan(static_cast<std::size_t>(batch.first_index),
                                       static_cast<std::size_t>(batch.index_count));
}

int SceneTriangles::skin_index_count() const {
    return batches_.front().material == Material::kSkin ? batches_.front().index_count : 0;
}

}  // namespace risorius::render
