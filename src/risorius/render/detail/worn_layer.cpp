// SPDX-License-Identifier: MIT
#include "risorius/render/detail/worn_layer.h"

#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/skin_plan.h"

namespace risorius::render {

WornLayer::WornLayer(const Scene& scene, bool bare, const Vec3& paint_centre, const Camera& camera,
                     const ShaderConstants& constants, bool layer)
    : locks_(scene, bare ? Hair{} : plan_hair(scene, plan_skin(scene, paint_centre), paint_centre),
             camera, constants, layer),
      garment_(scene, bare ? Garment{} : plan_garment(scene), camera, constants, layer) {}

std::vector<std::uint8_t> WornLayer::covered() const {
    std::vector<std::uint8_t> covered = locks_.covered();
    const std::vector<std::uint8_t>& cloth = garment_.covered();
    if (covered.empty()) return cloth;
    for (std::size_t v = 0; v < cloth.size(); ++v) covered[v] = covered[v] | cloth[v];
    return covered;
}

void WornLayer::upload(const Pose& pose) {
    locks_.upload(pose);
    garment_.upload(pose.positions);
}

void WornLayer::draw() const {
    locks_.draw();
    garment_.draw();
}

void WornLayer::touch(const Eigen::Matrix4f& clip_from_world, PictureCells& cells) {
    locks_.touch(clip_from_world, cells);
    garment_.touch(clip_from_world, cells);
}

void WornLayer::look_up_hair(const PictureCells& cells, const SkinLayer& layer) {
    if (locks_.empty()) return;
    layer.use(kHairBeyond_m);
    locks_.look_up(cells);
}

void WornLayer::look_up_garment(const PictureCells& cells) { garment_.look_up(cells); }

}  // namespace risorius::render
