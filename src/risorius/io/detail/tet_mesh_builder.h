// SPDX-License-Identifier: MIT
/// \file
/// Puts a tetrahedral mesh together from the nodes and tetrahedra of a file, and checks it.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "risorius/core/counter_rng.h"
#include "risorius/io/tet_mesh.h"

namespace risorius::io::detail {

inline constexpr std::size_t kMostTets = 15'000'000;
inline constexpr long long kLargestId = 1'000'000'000'000;

/// Of the name of a node. Its bits are mixed: names at equal distances could all share a bucket otherwise.
struct NodeHash {
    std::size_t operator()(long long id) const {
        return static_cast<std::size_t>(CounterRng().at(static_cast<std::uint64_t>(id)).bits());
    }
};

class TetMeshBuilder {
  public:
    explicit TetMeshBuilder(std::string name) : name_(std::move(name)) {}

    /// `id`: how tetrahedra call the node. Throws Error when it is there already.
    void add_node(long long id, const Vec3& at);
    void add_tet(const std::array<long long, 4>& nodes, int tag);
    std::size_t nodes() const { return positions_.size(); }
    std::map<std::string, int>& names() { return names_; }

    /// Throws Error for a tetrahedron with an unknown node, without volume, or turned otherwise than the rest; it is named by its number in
    /// the file, from 1.
    TetMesh finish();

  private:
    [[noreturn]] void fail(std::size_t tet, const std::string& expected,
                           const std::string& found) const;
    void check_volumes(TetMesh& mesh) const;

    std::string name_;
    std::vector<Vec3> positions_;
    std::unordered_map<long long, int, NodeHash> index_;
    std::vector<std::array<long long, 4>> tets_;
    std::vector<int> tags_;
    std::map<std::string, int> names_;
};

// The readers of the formats. `name` is the file in messages.
TetMesh read_msh(std::string_view bytes, const std::string& name);
TetMesh read_legacy_vtk(std::string_view bytes, const std::string& name);
TetMesh read_vtu(std::string_view bytes, const std::string& name);
TetMesh read_medit(std::string_view bytes, const std::string& name);
TetMesh read_meditb(std::string_view bytes, const std::string& name);
TetMesh read_tetgen(std::string_view nodes, const std::string& nodes_name, std::string_view tets,
                    const std::string& tets_name);

/// Whether cell data of VTK with this name are tags.
bool is_tag_name(std::string_view name);
/// Whether data of VTK with this name are directions of fibres.
bool is_fibre_name(std::string_view name);
/// The tag that a number in a file is; numbers that are no integers of 32 bits are 0.
int tag_of(double value);

}  // namespace risorius::io::detail
