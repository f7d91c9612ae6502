// SPDX-License-Identifier: MIT
#include "risorius/render/detail/skin_box.h"

#include "risorius/core/error.h"

namespace risorius::render {

SkinBox box_of_skin(const Scene& scene) {
    SkinBox box;
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != Material::kSkin) continue;
        for (Eigen::Index i = 0; i < surface.triangles.size(); ++i) {
            const int v = surface.triangles.data()[i];
            if (v < 0 || v >= scene.rest.rows()) continue;
            box.min = box.min.cwiseMin(scene.rest.row(v).transpose());
            box.max = box.max.cwiseMax(scene.rest.row(v).transpose());
        }
    }
    if (box.min.x() > box.max.x()) throw Error("scene/surfaces", "a skin surface", "none");
    return box;
}

}  // namespace risorius::render
