// SPDX-License-Identifier: MIT
#include "risorius/render/detail/baked_scene.h"

#include <string>
#include <utility>

#include "risorius/core/result_cache.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/lash_strands.h"
#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/detail/skin_plan.h"

namespace risorius::render {

namespace {

/// The computation as its name and the OpenGL implementation that makes it.
CacheKey key_for(const char* computation) {
    CacheKey key(computation);
    for (const GLenum name : {GL_RENDERER, GL_VERSION})
        key.add(std::string(reinterpret_cast<const char*>(glGetString(name))));
    return key;
}

/// The sky that each vertex sees.
struct Sky {
    std::vector<float> measured, rest;  ///< at rest, before and after it is smoothed
    std::vector<float> shut;  ///< with shut eyes, smoothed; empty when the scene has no lids
};

std::string key_of_sky(const Scene& scene, const SceneBuffers& buffers, const Vec3& centre,
                       double reach_m) {
    CacheKey key = key_for("render/sky");
    key.add(scene.rest).add(scene.shut).add(buffers.indices());
    for (const Batch& batch : buffers.batches())
        key.add(batch.material).add(batch.first_index).add(batch.index_count);
    return key.add(centre).add(reach_m).finish();
}

/// The triangles of the skin, which has the finest folds, in nostrils and ears.
std::vector<unsigned> skin_corners(const SceneBuffers& buffers) {
    std::vector<unsigned> skin;
    for (const Batch& batch : buffers.batches())
        if (batch.material == Material::kSkin)
            skin.insert(skin.end(), buffers.indices().begin() + batch.first_index,
                        buffers.indices().begin() + batch.first_index + batch.index_count);
    return skin;
}

Sky sky_of(const Scene& scene, SceneBuffers& buffers, const Vec3& centre, double reach_m) {
    const auto measured = [&](const Points& positions) {
        return sky_seen(positions, buffers.normals(), buffers.batches(), centre, reach_m);
    };
    const std::vector<unsigned> skin = skin_corners(buffers);
    const auto smoothed = [&](const std::vector<float>& seen, const Points& positions) {
        constexpr int kMoreOfSkin = 3;
        return with_neighbours(
            with_neighbours(seen, positions, buffers.normals(), buffers.indices(), 1), positions,
            buffers.normals(), skin, kMoreOfSkin);
    };
    return cached_result(
        key_of_sky(scene, buffers, centre, reach_m),
        [&] {
            Sky sky;
            sky.measured = measured(scene.rest);
            sky.rest = smoothed(sky.measured, scene.rest);
            if (scene.shut.rows() == 0) return sky;
            buffers.upload(scene.shut);
            sky.shut = smoothed(measured(scene.shut), scene.shut);
            buffers.upload(scene.rest);
            return sky;
        },
        [](Sky& sky, const auto& visit) {
            visit(sky.measured);
            visit(sky.rest);
            visit(sky.shut);
        });
}

// The bindings name all members, so that a new one does not compile until it is added here or left out on purpose.
void add_look(const Scene& scene, CacheKey& key) {
    const auto& [rest, shut, surfaces, textures, landmarks, eyes, appearance, fold_phase, muscles,
                 bones] = scene;
    key.add(rest).add(fold_phase);
    for (const Surface& surface : surfaces) {
        const auto& [material, triangles, texcoords, eye, reflectance, texture] = surface;
        key.add(material).add(triangles).add(texcoords).add(eye).add(texture);
    }
    for (const Image& image : textures)
        key.add(image.width_px).add(image.height_px).add(image.rgba).add(image.deep);
    for (const auto& [id, place] : landmarks) key.add(id).add(place);
    for (const Eye& eye : eyes) {
        const auto& [centre, radius_m, iris_radius_m, pupil_radius_m, forward] = eye;
        key.add(centre).add(radius_m).add(iris_radius_m).add(pupil_radius_m).add(forward);
    }
    const auto& [skin_tone, lip_tone, hair_tone, iris_tone, freckles, scalp_hair, hairline_mm,
                 temples_mm, hair_length_mm, beard_length_mm, beard, age, seed, hair_style,
                 lock_length, lock_wave, fringe, parting, hairline_form, age_lines, grey_hair,
                 beard_form, brow_density, brow_width, skin_gloss, complexion, mottling, garment,
                 garment_tone] = appearance;
    key.add(skin_tone).add(lip_tone).add(hair_tone).add(iris_tone).add(freckles).add(scalp_hair);
    key.add(hairline_mm).add(temples_mm).add(hair_length_mm).add(beard_length_mm).add(beard);
    key.add(age).add(seed).add(hair_style).add(hairline_form).add(age_lines);
    key.add(grey_hair.value_or(-1.0));  // no share is below 0
    key.add(beard_form).add(brow_density).add(brow_width).add(complexion).add(mottling);
    // Garment, gloss of the skin and form of the locks are not baked.
}

std::vector<std::uint8_t> paint_of(const Scene& scene, const SceneBuffers& buffers,
                                   const BakedScene& baked, const Vec3& centre, int side) {
    const std::vector<unsigned> triangles = buffers.paintable_triangles(baked.inside);
    CacheKey key = key_for("render/paint");
    add_look(scene, key);
    key.add(buffers.indices()).add(triangles).add(centre).add(side);
    struct Paint {
        std::vector<std::uint8_t> texels;
    };
    return cached_result(
               key.finish(),
               [&] {
                   return Paint{paint_skin(scene, buffers, *baked.own, centre, triangles, side)};
               },
               [](Paint& paint, const auto& visit) { visit(paint.texels); })
        .texels;
}

/// The lash ribbons of the mesh are drawn only where no lashes can be generated.
void grow_hair(const Scene& scene, const Vec3& centre, const SceneBuffers& buffers,
               BakedScene& out) {
    if (!has_own_skin(scene))
        out.hair = plan_brows(scene, plan_skin(scene, centre), centre,
                              buffers.paintable_triangles(out.inside));
    bool lashes = true;
    for (const int eye : {0, 1}) {
        const std::vector<Strand> some = plan_lashes(scene, eye);
        lashes &= !some.empty();
        out.hair.insert(out.hair.end(), some.begin(), some.end());
    }
    out.mesh_lashes = !lashes;
}

}  // namespace

BakedScene::~BakedScene() {
    glDeleteTextures(1, &paint_map);
    glDeleteTextures(1, &pore_map);
}

std::shared_ptr<BakedScene> bake_scene(const Scene& scene, SceneBuffers& buffers,
                                       const PosedMarks& marks, const Vec3& centre,
                                       const BakeOptions& options) {
    auto out = std::make_shared<BakedScene>();
    Sky sky = sky_of(scene, buffers, centre, options.sky_reach_m);
    out->inside = marks.inside_mouth(scene, sky.measured);
    out->sky = std::move(sky.rest);
    if (!sky.shut.empty()) out->sky_about_eyes.emplace(scene, out->sky, sky.shut);
    out->own = std::make_unique<OwnTextures>(scene, buffers);
    out->paint_map = make_paint_map(
        options.paint_side, paint_of(options.show_muscles ? without_hair(scene) : scene, buffers,
                                     *out, centre, options.paint_side));
    out->pore_map = make_pores(scene.appearance.seed);
    grow_hair(scene, centre, buffers, *out);
    finish_drawing();  // other contexts may read the maps from now on
    return out;
}

Scene without_hair(Scene scene) {
    scene.appearance.scalp_hair = scene.appearance.hair_length_mm =
        scene.appearance.beard_length_mm = 0;
    scene.appearance.hair_style = "shaven";
    return scene;
}

}  // namespace risorius::render
