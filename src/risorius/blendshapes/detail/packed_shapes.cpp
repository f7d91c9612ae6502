// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/packed_shapes.h"

namespace risorius::blendshapes {

PackedShapes::PackedShapes(const BlendShapeRig& rig) {
    const auto add = [&](const SparseShape& from) {
        Shape& shape = shapes_.emplace_back();
        for (std::size_t i = 0; i < from.vertex.size(); ++i) {
            if (i == 0 || from.vertex[i] != from.vertex[i - 1] + 1)
                shape.runs.push_back({from.vertex[i], 0});
            ++shape.runs.back().count;
            for (int k = 0; k < 3; ++k)
                shape.delta.push_back(static_cast<float>(from.delta(static_cast<long>(i), k)));
        }
    };
    for (const SparseShape& shape : rig.shapes) add(shape);
    for (const Corrective& corrective : rig.correctives) add(corrective.shape);
}

void PackedShapes::add_to(Points& vertices, const Eigen::VectorXd& all_weights) const {
    for (std::size_t s = 0; s < shapes_.size(); ++s) {
        const double weight = all_weights[static_cast<long>(s)];
        if (weight == 0) continue;
        const float* delta = shapes_[s].delta.data();
        for (const Run& run : shapes_[s].runs) {
            double* to = vertices.data() + 3 * run.first;
            for (long i = 0; i < 3 * run.count; ++i)
                to[i] += weight * static_cast<double>(delta[i]);
            delta += 3 * run.count;
        }
    }
}

}  // namespace risorius::blendshapes
