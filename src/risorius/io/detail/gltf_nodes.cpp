// SPDX-License-Identifier: MIT
#include "risorius/io/detail/gltf_nodes.h"

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
    std::vector<Eigen::Matrix4d> own, out;
    for (const JsonCursor& node : nodes) own.push_back(detail::transform_of(node));
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        Eigen::Matrix4d place = own[n];
        std::size_t depth = 0;
        for (std::size_t up = parent[n]; up < nodes.size(); up = parent[up]) {
            if (++depth > nodes.size())
                nodes[n].fail("a node that is not inside of itself", "one that is");
            place = own[up] * place;
        }
        out.push_back(place);
    }
    return out;
}

/// Where the first joint of a skin carries the vertices at rest; the others carry them to the same place.
Eigen::Matrix4d place_of_skin(const GltfFile& from, const JsonCursor& skin,
                              const std::vector<Eigen::Matrix4d>& places) {
    const auto joints = skin.find("joints"), matrices = skin.find("inverseBindMatrices");
    if (!joints || joints->items().empty() || !matrices) return Eigen::Matrix4d::Identity();
    const JsonCursor& accessor = from.item("accessors", *matrices);
    const Rows rows = from.rows(accessor, 16);
    if (rows.rows() < 1 || !rows.allFinite()) accessor.fail("finite matrices", "others");
    const auto joint = static_cast<std::size_t>(&from.item("nodes", joints->items()[0]) -
                                                from.list("nodes").data());
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

}  // namespace risorius::io::detail
