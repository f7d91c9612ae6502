// SPDX-License-Identifier: MIT
#include "risorius/io/detail/tet_mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "risorius/core/error.h"
#include "risorius/io/detail/mesh_limits.h"

namespace risorius::io::detail {

namespace {

/// Volume over that of a cube of the longest edge, below which a tetrahedron counts as flat.
constexpr double kFlat = 1e-10;

}  // namespace

void TetMeshBuilder::add_node(long long id, const Vec3& at) {
    if (positions_.size() == kMostVertices) throw Error(name_, kFewerVertices, "more");
    if (!at.allFinite())
        throw Error(name_ + ", node " + std::to_string(id), "finite coordinates", "others");
    if (!index_.emplace(id, static_cast<int>(positions_.size())).second)
        throw Error(name_ + ", node " + std::to_string(id), "each node once", "it again");
    positions_.push_back(at);
}

void TetMeshBuilder::add_tet(const std::array<long long, 4>& nodes, int tag) {
    if (tets_.size() == kMostTets) throw Error(name_, "at most 15 million tetrahedra", "more");
    tets_.push_back(nodes);
    tags_.push_back(tag);
}

void TetMeshBuilder::fail(std::size_t tet, const std::string& expected,
                          const std::string& found) const {
    throw Error(name_ + ", tetrahedron " + std::to_string(tet + 1), expected, found);
}

void TetMeshBuilder::check_volumes(TetMesh& mesh) const {
    std::vector<double> volume;
    std::size_t turned = 0;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
        Mat3 edges;
        double longest = 0;
        for (int k = 0; k < 3; ++k)
            edges.col(k) =
                (mesh.positions.row(mesh.tets(t, k + 1)) - mesh.positions.row(mesh.tets(t, 0)))
                    .transpose();
        for (int k = 0; k < 3; ++k)
            longest = std::max(
                {longest, edges.col(k).norm(), (edges.col(k) - edges.col((k + 1) % 3)).norm()});
        volume.push_back(edges.determinant());
        if (!(std::abs(volume.back()) > kFlat * longest * longest * longest))
            fail(static_cast<std::size_t>(t), "a tetrahedron with a volume", "a flat one");
        turned += volume.back() < 0;
    }
    const bool turn_all = 2 * turned > volume.size();
    for (std::size_t t = 0; t < volume.size(); ++t)
        if ((volume[t] < 0) != turn_all)
            fail(t, "corners in the same order as those of the other tetrahedra",
                 "an inverted tetrahedron");
    if (turn_all) mesh.tets.col(2).swap(mesh.tets.col(3));
}

TetMesh TetMeshBuilder::finish() {
    if (tets_.empty()) throw Error(name_, "tetrahedra with four nodes", "none");
    TetMesh mesh;
    mesh.tets.resize(static_cast<Eigen::Index>(tets_.size()), 4);
    std::vector<int> new_index(positions_.size(), -1);
    for (std::size_t t = 0; t < tets_.size(); ++t)
        for (int k = 0; k < 4; ++k) {
            const long long id = tets_[t][static_cast<std::size_t>(k)];
            const auto found = index_.find(id);
            if (found == index_.end()) fail(t, "nodes of the file", "node " + std::to_string(id));
            mesh.tets(static_cast<Eigen::Index>(t), k) = found->second;
            new_index[static_cast<std::size_t>(found->second)] = 0;
        }
    int used = 0;
    for (int& index : new_index)
        if (index == 0) index = used++;
    mesh.positions.resize(used, 3);
    for (std::size_t i = 0; i < positions_.size(); ++i)
        if (new_index[i] >= 0) mesh.positions.row(new_index[i]) = positions_[i].transpose();
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k)
            mesh.tets(t, k) = new_index[static_cast<std::size_t>(mesh.tets(t, k))];
    mesh.tags = std::move(tags_);
    mesh.names = std::move(names_);
    check_volumes(mesh);
    return mesh;
}

bool is_tag_name(std::string_view name) {
    for (const char* known :
         {"tag", "region", "material", "gmsh:physical", "CellEntityIds", "medit:ref"})
        if (name == known) return true;
    return false;
}

bool is_fibre_name(std::string_view name) {
    for (const char* known :
         {"fibre", "fiber", "fibres", "fibers", "fibre_direction", "fiber_direction"})
        if (name == known) return true;
    return false;
}

int tag_of(double value) {
    const bool whole =
        value == std::floor(value) && std::abs(value) <= std::numeric_limits<int>::max();
    return whole ? static_cast<int>(value) : 0;
}

}  // namespace risorius::io::detail
