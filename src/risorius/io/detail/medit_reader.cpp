// SPDX-License-Identifier: MIT
// Medit .mesh and .meshb, and TetGen .node with .ele. Sources: P. Frey 2001, INRIA RT-0253, Medit; L. Marechal, libMeshb 7 (binary files);
// H. Si, TetGen manual 1.6.
#include <bit>

#include "risorius/core/error.h"
#include "risorius/io/detail/mesh_limits.h"
#include "risorius/io/detail/mesh_scanner.h"
#include "risorius/io/detail/tet_mesh_builder.h"

namespace risorius::io::detail {

namespace {

constexpr long long kLargestReference = 2'147'483'647;

/// Numbers in an item of each section that is passed over, with the reference.
struct MeditSection {
    std::string_view name;
    int numbers;
};
constexpr MeditSection kPassedOver[] = {{"Edges", 3},
                                        {"Triangles", 4},
                                        {"Quadrilaterals", 5},
                                        {"Hexahedra", 9},
                                        {"Prisms", 7},
                                        {"Pyramids", 6},
                                        {"Corners", 1},
                                        {"Ridges", 1},
                                        {"RequiredVertices", 1},
                                        {"RequiredEdges", 1},
                                        {"RequiredTriangles", 1},
                                        {"Normals", 3},
                                        {"NormalAtVertices", 2},
                                        {"Tangents", 3},
                                        {"TangentAtVertices", 2}};

}  // namespace

TetMesh read_medit(std::string_view bytes, const std::string& name) {
    MeshScanner in(bytes, name, '#');
    TetMeshBuilder mesh(name);
    in.expect("MeshVersionFormatted");
    in.integer("the version", 1, 4);
    for (std::string_view key = in.word(); !key.empty() && key != "End"; key = in.word()) {
        if (key == "Dimension") {
            in.integer("the dimension 3", 3, 3);
        } else if (key == "Vertices") {
            const std::size_t count = in.count("vertices", 8, kMostVertices);
            for (std::size_t i = 0; i < count; ++i) {
                Vec3 at;
                for (int k = 0; k < 3; ++k) at[k] = in.number("a coordinate");
                in.number("the reference of a vertex");
                mesh.add_node(static_cast<long long>(i + 1), at);
            }
        } else if (key == "Tetrahedra") {
            const std::size_t count = in.count("tetrahedra", 10, kMostTets);
            for (std::size_t i = 0; i < count; ++i) {
                std::array<long long, 4> nodes{};
                for (long long& node : nodes) node = in.integer("a vertex", 1, kLargestId);
                mesh.add_tet(nodes, static_cast<int>(in.integer("a reference", -kLargestReference,
                                                                kLargestReference)));
            }
        } else {
            const MeditSection* known = nullptr;
            for (const MeditSection& section : kPassedOver)
                if (section.name == key) known = &section;
            if (known == nullptr)
                in.fail("a section of a mesh, as Tetrahedra",
                        "\"" + std::string(key.substr(0, 24)) + "\"");
            const std::size_t count =
                in.count(key, static_cast<std::size_t>(2 * known->numbers), 6 * kMostTets);
            for (std::size_t i = 0; i < count * static_cast<std::size_t>(known->numbers); ++i)
                in.number(known->name);
        }
    }
    return mesh.finish();
}

/// A binary file: 1 as an integer, which tells the order of bytes, the version, and sections. A section has its number, the place of the
/// next one (0: none), and, but for the dimension, how many items it has. Version 1 has short reals, 4 long integers, 3 and 4 long places.
TetMesh read_meditb(std::string_view bytes, const std::string& name) {
    constexpr long long kDimension = 3, kVertices = 4, kTetrahedra = 8, kEnd = 54;
    MeshScanner in(bytes, name);
    const auto fail = [&](const std::string& expected, const std::string& found) {
        throw Error(name, expected, found);
    };
    const bool swapped =
        !in.bytes(4, "the order of bytes")
             .starts_with(std::endian::native == std::endian::little ? '\1' : '\0');
    in.go_to(0);
    in.binary_integer(Scalar::kInt32, swapped, "1 as the first integer", 1, 1);
    const long long version = in.binary_integer(Scalar::kInt32, swapped, "the version", 1, 4);
    const Scalar real = version == 1 ? Scalar::kFloat : Scalar::kDouble,
                 integer = version == 4 ? Scalar::kInt64 : Scalar::kInt32,
                 place = version >= 3 ? Scalar::kInt64 : Scalar::kInt32;
    const auto count = [&](std::string_view what, std::size_t bytes_each, std::size_t most) {
        const auto items = static_cast<std::size_t>(
            in.binary_integer(integer, swapped, "the number of " + std::string(what), 0,
                              static_cast<long long>(most)));
        if (items > in.left() / bytes_each)
            fail("as many bytes as " + std::to_string(items) + " " + std::string(what) + " take",
                 std::to_string(in.left()));
        return items;
    };
    TetMeshBuilder mesh(name);
    while (in.left() >= 4) {
        const long long section =
            in.binary_integer(Scalar::kInt32, swapped, "the number of a section", 0, 10'000);
        if (section == kEnd) break;
        const auto next = static_cast<std::size_t>(
            in.binary_integer(place, swapped, "the place of the next section", 0,
                              static_cast<long long>(bytes.size())));
        if (next != 0 && next < in.position())
            fail("a next section behind the one before", "place " + std::to_string(next));
        if (section == kDimension) {
            in.binary_integer(Scalar::kInt32, swapped, "the dimension 3", 3, 3);
        } else if (section == kVertices) {
            const std::size_t items =
                count("vertices", 3 * bytes_of(real) + bytes_of(integer), kMostVertices);
            for (std::size_t i = 0; i < items; ++i) {
                const std::vector<double> at = in.numbers(3, real, swapped, "a vertex");
                in.binary_integer(integer, swapped, "the reference of a vertex", -kLargestReference,
                                  kLargestReference);
                mesh.add_node(static_cast<long long>(i + 1), Vec3(at[0], at[1], at[2]));
            }
        } else if (section == kTetrahedra) {
            const std::size_t items = count("tetrahedra", 5 * bytes_of(integer), kMostTets);
            for (std::size_t i = 0; i < items; ++i) {
                std::array<long long, 4> nodes{};
                for (long long& node : nodes)
                    node = in.binary_integer(integer, swapped, "a vertex", 1, kLargestReference);
                mesh.add_tet(nodes, static_cast<int>(
                                        in.binary_integer(integer, swapped, "a reference",
                                                          -kLargestReference, kLargestReference)));
            }
        }
        if (next == 0) break;
        in.go_to(next);
    }
    return mesh.finish();
}

TetMesh read_tetgen(std::string_view nodes, const std::string& nodes_name, std::string_view tets,
                    const std::string& tets_name) {
    TetMeshBuilder mesh(tets_name);
    MeshScanner in(nodes, nodes_name, '#');
    const std::size_t count = in.count("nodes", 0, kMostVertices);
    in.integer("the dimension 3", 3, 3);
    const long long attributes = in.integer("the number of attributes", 0, 1000);
    const long long marker = in.integer("0, or 1 for markers", 0, 1);
    if (count > (in.left() + 1) / 8)
        in.fail("as many bytes as " + std::to_string(count) + " nodes take",
                std::to_string(in.left()));
    for (std::size_t i = 0; i < count; ++i) {
        const long long id = in.integer("the number of a node", 0, kLargestId);
        Vec3 at;
        for (int k = 0; k < 3; ++k) at[k] = in.number("a coordinate");
        for (long long k = 0; k < attributes + marker; ++k) in.number("an attribute");
        mesh.add_node(id, at);
    }
    MeshScanner cells(tets, tets_name, '#');
    const std::size_t tet_count = cells.count("tetrahedra", 0, kMostTets);
    cells.integer("4 nodes of a linear tetrahedron", 4, 4);
    const long long tag_columns = cells.integer("the number of attributes", 0, 1000);
    if (tet_count > (cells.left() + 1) / 10)
        cells.fail("as many bytes as " + std::to_string(tet_count) + " tetrahedra take",
                   std::to_string(cells.left()));
    for (std::size_t i = 0; i < tet_count; ++i) {
        cells.integer("the number of a tetrahedron", 0, kLargestId);
        std::array<long long, 4> corners{};
        for (long long& node : corners) node = cells.integer("a node", 0, kLargestId);
        int tag = 0;
        for (long long k = 0; k < tag_columns; ++k) {
            const double attribute = cells.number("an attribute");
            if (k == 0) tag = tag_of(attribute);
        }
        mesh.add_tet(corners, tag);
    }
    return mesh.finish();
}

}  // namespace risorius::io::detail
