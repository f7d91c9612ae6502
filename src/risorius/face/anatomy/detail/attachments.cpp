// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/detail/attachments.h"

#include <cmath>

namespace risorius::face {

std::vector<Attachment> place_attachments(const rig::Head& head, const rig::RigDescription& rig,
                                          const Jaw& jaw, const Shell& shell,
                                          const TissueMesh& mesh) {
    std::vector<Attachment> out;
    for (int v = 0; v < static_cast<int>(shell.vertex.size()); ++v) {
        if (shell.fixed[v]) continue;
        const Vec3 skin = mesh.nodes.row(node_of(v, kSkin)).transpose();
        // Stiffness spans six decades: interpolate its logarithm, inverse distance to the power 4.
        double log_normal = 0, log_tangential = 0, weights = 0;
        for (const rig::AttachmentSample& sample : rig.atlas.attachments) {
            const double squared = (skin - head.landmark(sample.landmark)).squaredNorm() + 1e-10;
            const double w = 1.0 / (squared * squared);
            log_normal += w * std::log(sample.normal_pa_per_m);
            log_tangential += w * std::log(sample.tangential_pa_per_m);
            weights += w;
        }
        out.push_back({v, std::exp(log_normal / weights) * mesh.area_m2[v],
                       std::exp(log_tangential / weights) * mesh.area_m2[v],
                       jaw.weight(skin, shell.over_bite_m[v]), jaw.floor_bulge(skin)});
    }
    return out;
}

}  // namespace risorius::face
