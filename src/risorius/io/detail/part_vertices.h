// SPDX-License-Identifier: MIT
/// \file
/// The vertices of a part of a model as glTF wants them, which has one texture coordinate for each vertex.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "risorius/io/detail/gltf_packer.h"
#include "risorius/io/morph_model.h"

namespace risorius::io::detail {

/// The vertices of a part: one for every vertex of the model that it uses, and one more for every further texture coordinate
/// there.
struct PartVertices {
    std::vector<int> vertex;  ///< index in the model
    std::vector<std::array<double, 2>> texcoord;
    std::vector<unsigned> corner;  ///< 3F

    explicit PartVertices(const MorphPart& part) {
        using Key = std::pair<int, std::array<double, 2>>;
        const bool mapped = part.texcoords.rows() > 0;
        std::map<Key, unsigned> index;
        const auto key = [&](long c) {
            const std::array<double, 2> at =
                mapped ? std::array{part.texcoords(c, 0), part.texcoords(c, 1)}
                       : std::array{0.0, 0.0};
            return Key{part.triangles(c / 3, c % 3), at};
        };
        const long corners = 3 * part.triangles.rows();
        for (long c = 0; c < corners; ++c) index.emplace(key(c), 0);
        for (auto& [at, number] : index) {
            number = static_cast<unsigned>(vertex.size());
            vertex.push_back(at.first);
            texcoord.push_back(at.second);
        }
        for (long c = 0; c < corners; ++c) corner.push_back(index.at(key(c)));
    }
    unsigned count() const { return static_cast<unsigned>(vertex.size()); }
    Floats gather(const Points& of) const {
        Floats out;
        for (const int v : vertex)
            for (int k = 0; k < 3; ++k) out.push_back(static_cast<float>(of(v, k)));
        return out;
    }
};

}  // namespace risorius::io::detail
