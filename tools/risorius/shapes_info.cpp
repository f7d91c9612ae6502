// SPDX-License-Identifier: MIT
#include "tools/risorius/shapes_info.h"

#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/io/gltf_shapes.h"

namespace risorius::cli {

Json shapes_info(const std::filesystem::path& file) {
    const io::GltfShapes read = io::read_gltf_shapes(file);
    Json out;
    out["file"] = file.generic_string();
    out["by_risorius"] = read.by_risorius;
    out["vertices"] = read.positions.rows();
    out["shapes"] = Json::array();
    for (const io::MorphTarget& shape : read.targets) {
        const double largest_m =
            shape.delta.rows() > 0 ? shape.delta.rowwise().norm().maxCoeff() : 0.0;
        out["shapes"].push_back(json_object({{"name", shape.name},
                                             {"vertices", shape.vertex.size()},
                                             {"largest_mm", 1000 * largest_m}}));
    }
    return out;
}

}  // namespace risorius::cli
