// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/live_link.h"

#include "risorius/blendshapes/detail/shape_animation.h"
#include "risorius/face/quality.h"

namespace risorius::blendshapes {

std::string live_link_of_script(const std::filesystem::path& script, const scene::RigFiles& files,
                                const std::string& quality) {
    const ShapeSet set = shape_set(files.rig, "arkit52", {}, files.place());
    face::Face face(files.rig, files.mesh, face::quality_named(quality), files.place());
    const ShapeWeights weights(face, files.rig.channels(), set.goals);
    return live_link_table(bake_script(script, files, set.goals, weights));
}

}  // namespace risorius::blendshapes
