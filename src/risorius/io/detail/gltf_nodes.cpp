// SPDX-License-Identifier: MIT
#include "risorius/io/detail/gltf_nodes.h"

#include <algorithm>

#include "risorius/core/error.h"
#include "risorius/io/detail/gltf_mesh.h"

namespace risorius::io::detail {

namespace {

/// Where each node is: the transforms from the root down to it.
std::vector<Eigen::Matrix4d> places_of(const GltfFile& from) {
    const std::vector<JsonCursor>& nodes = from.list("nodes");
    std::vector<std::size_t> parent(nodes.size(), nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n)
        if (const auto children = nodes[n].find("children"))
            for (const JsonCursor& reference : children->items())
                parent[static_cast<std::size_t>(&from.item("nodes", reference) - nodes.data())] = n;
    std::vector<Eigen::Matrix4d> out;
    for (const JsonCursor& node : nodes) out.push_back(detail::transform_of(node));
    // From each node up to the first whose place is known, and down again: each node is met once, however deep they lie.
    std::vector<char> known(nodes.size(), 0);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        std::vector<std::size_t> way;
        for (std::size_t up = n; up < nodes.size() && !known[up]; up = parent[up]) {
            if (way.size() == nodes.size())
                nodes[n].fail("a node that is not inside of itself", "one that is");
            way.push_back(up);
        }
        for (; !way.empty(); way.pop_back()) {
            const std::size_t node = way.back(), above = parent[node];
            if (above < nodes.size()) out[node] = out[above] * out[node];
            known[node] = 1;
        }
    }
    return out;
}

/// Where the first joint of a skin carries the vertices at rest; the others carry them to the same place.
Eigen::Matrix4d place_of_skin(const GltfFile& from, const JsonCursor& skin,
                              const std::vector<Eigen::Matrix4d>& places) {
    const auto joints = skin.find("joints"), matrices = skin.find("inverseBindMatrices");
    const std::vector<JsonCursor> listed = joints ? joints->items() : std::vector<JsonCursor>{};
    if (listed.empty() || !matrices) return Eigen::Matrix4d::Identity();
    from.spend(*joints, listed.size());
    const JsonCursor& accessor = from.item("accessors", *matrices);
    const Rows rows = from.rows(accessor, 16);
    if (rows.rows() < 1 || !rows.allFinite()) accessor.fail("finite matrices", "others");
    const auto joint =
        static_cast<std::size_t>(&from.item("nodes", listed[0]) - from.list("nodes").data());
    return places[joint] * Eigen::Map<const Eigen::Matrix4d>(rows.data());
}

}  // namespace

std::vector<PlacedMesh> placed_meshes(const GltfFile& from) {
    const std::vector<Eigen::Matrix4d> places = places_of(from);
    const std::vector<JsonCursor>& nodes = from.list("nodes");
    std::vector<PlacedMesh> out;
    for (std::size_t n = 0; n < nodes.size(); ++n)
        if (const auto mesh = nodes[n].find("mesh")) {
            const auto skin = nodes[n].find("skin");
            out.push_back(
                {n, from.item("meshes", *mesh),
                 skin ? place_of_skin(from, from.item("skins", *skin), places) : places[n]});
        }
    return out;
}

bool is_worn(const std::vector<JsonCursor>& primitives) {
    return std::none_of(primitives.begin(), primitives.end(), [](const JsonCursor& primitive) {
        return primitive.at("attributes").has("_VERTEX");
    });
}

}  // namespace risorius::io::detail
