// SPDX-License-Identifier: MIT
// Unstructured grids of VTK in the legacy format. Source: VTK File Formats, in The VTK User's Guide, Kitware, 11th edition, 2010; versions 3
// to 5.1.
#include <algorithm>
#include <bit>

#include "risorius/core/error.h"
#include "risorius/io/detail/mesh_limits.h"
#include "risorius/io/detail/mesh_scanner.h"
#include "risorius/io/detail/tet_mesh_builder.h"
#include "risorius/io/detail/vtk_cells.h"

namespace risorius::io::detail {

namespace {

struct LegacyName {
    const char* name;
    Scalar type;
};
constexpr LegacyName kLegacyNames[] = {
    {"char", Scalar::kInt8},          {"unsigned_char", Scalar::kUInt8},
    {"short", Scalar::kInt16},        {"unsigned_short", Scalar::kUInt16},
    {"int", Scalar::kInt32},          {"unsigned_int", Scalar::kUInt32},
    {"long", Scalar::kInt64},         {"unsigned_long", Scalar::kUInt64},
    {"float", Scalar::kFloat},        {"double", Scalar::kDouble},
    {"vtkIdType", Scalar::kInt32},    {"vtktypeint64", Scalar::kInt64},
    {"vtktypeint32", Scalar::kInt32}, {"vtktypeuint64", Scalar::kUInt64}};

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

class LegacyReader {
  public:
    LegacyReader(std::string_view bytes, const std::string& name)
        : in_(bytes, name), cells_(name) {}

    TetMesh read() {
        if (!in_.line().starts_with("# vtk DataFile Version"))
            in_.fail("a first line that begins with \"# vtk DataFile Version\"", "another");
        in_.line();  // the title
        const std::string form(in_.word());
        if (form != "ASCII" && form != "BINARY") in_.fail("ASCII or BINARY", form.substr(0, 24));
        binary_ = form == "BINARY";
        in_.expect("DATASET");
        in_.expect("UNSTRUCTURED_GRID");
        for (std::string key = lower(in_.word()); !key.empty(); key = lower(in_.word()))
            read_part(key);
        return cells_.finish();
    }

  private:
    Scalar type() {
        const std::string name = lower(in_.word());
        for (const LegacyName& known : kLegacyNames)
            if (lower(known.name) == name) return known.type;
        in_.fail("a type of numbers", "\"" + name.substr(0, 24) + "\"");
    }

    std::vector<double> numbers(std::size_t count, Scalar type, std::string_view what) {
        if (binary_) {
            in_.line();
            return in_.numbers(count, type, std::endian::native == std::endian::little, what);
        }
        if (count > (in_.left() + 1) / 2)
            in_.fail(std::to_string(count) + " numbers of " + std::string(what),
                     std::to_string(in_.left()) + " bytes");
        std::vector<double> out;
        for (std::size_t i = 0; i < count; ++i) out.push_back(in_.number(what));
        return out;
    }

    void read_part(const std::string& key) {
        if (key == "points") {
            const std::size_t count = in_.count("points", 3, kMostVertices);
            const Scalar of = type();
            cells_.points = numbers(3 * count, of, "points");
        } else if (key == "cells") {
            read_cells();
        } else if (key == "cell_types") {
            cells_.types = numbers(in_.count("types", 1, 4 * kMostTets), Scalar::kInt32, "types");
        } else if (key == "cell_data") {
            rows_ = in_.count("values of cells", 0, 4 * kMostTets);
            of_cells_ = true;
        } else if (key == "point_data") {
            rows_ = in_.count("values of points", 0, kMostVertices);
            of_cells_ = false;
        } else if (key == "scalars") {
            const std::string name(in_.word());
            const Scalar of = type();
            std::size_t components = 1;
            std::string next(in_.word());
            if (next != "LOOKUP_TABLE") {
                components = next.size() == 1 && next[0] >= '1' && next[0] <= '4'
                                 ? static_cast<std::size_t>(next[0] - '0')
                                 : 0;
                if (components == 0)
                    in_.fail("1 to 4 components", "\"" + next.substr(0, 24) + "\"");
                in_.expect("LOOKUP_TABLE");
            }
            in_.word();
            keep(name, components, numbers(components * rows_, of, name));
        } else if (key == "vectors" || key == "normals" || key == "tensors") {
            const std::string name(in_.word());
            const Scalar of = type();
            const std::size_t components = key == "tensors" ? 9 : 3;
            keep(name, components, numbers(components * rows_, of, name));
        } else if (key == "field") {
            in_.word();
            const std::size_t arrays = in_.count("arrays", 4, kMostVertices);
            for (std::size_t i = 0; i < arrays; ++i) {
                const std::string name(in_.word());
                if (name == "METADATA") {
                    skip_metadata();
                    --i;
                    continue;
                }
                const auto components =
                    static_cast<std::size_t>(in_.integer("the number of components", 0, 1000));
                const std::size_t rows = in_.count("values", 0, 4 * kMostTets);
                const Scalar of = type();
                keep(name, components, numbers(components * rows, of, name));
            }
        } else if (key == "metadata") {
            skip_metadata();
        } else {
            in_.fail("POINTS, CELLS, CELL_TYPES, CELL_DATA or POINT_DATA",
                     "\"" + key.substr(0, 24) + "\"");
        }
    }

    /// It ends with an empty line.
    void skip_metadata() {
        in_.line();
        while (in_.left() > 0 && !in_.line().empty()) {
        }
    }

    void keep(const std::string& name, std::size_t components, std::vector<double> values) {
        if (components == 3 && is_fibre_name(name))
            (of_cells_ ? cells_.cell_fibres : cells_.point_fibres) = std::move(values);
        else if (of_cells_ && components == 1 && is_tag_name(name))
            cells_.tags = std::move(values);
    }

    void read_cells() {
        const std::size_t first = in_.count("cells", 1, 4 * kMostTets);
        const std::size_t second = in_.count("numbers of cells", 1, 20 * kMostTets);
        const std::size_t before = in_.position();
        if (lower(in_.word()) == "offsets") {  // version 5
            const Scalar of = type();
            cells_.offsets = numbers(first, of, "offsets");
            in_.expect("CONNECTIVITY");
            const Scalar nodes = type();
            cells_.connectivity = numbers(second, nodes, "connectivity");
            return;
        }
        in_.go_to(before);
        const std::vector<double> all = numbers(second, Scalar::kInt32, "cells");
        cells_.offsets.push_back(0);
        for (std::size_t at = 0, cell = 0; cell < first; ++cell) {
            if (at >= all.size() || !(all[at] >= 0) ||
                all[at] > static_cast<double>(all.size() - at - 1))
                in_.fail("a cell with its nodes",
                         "too few numbers in cell " + std::to_string(cell + 1));
            const auto nodes = static_cast<std::size_t>(all[at]);
            cells_.connectivity.insert(cells_.connectivity.end(),
                                       all.begin() + static_cast<long>(at + 1),
                                       all.begin() + static_cast<long>(at + 1 + nodes));
            at += nodes + 1;
            cells_.offsets.push_back(static_cast<double>(cells_.connectivity.size()));
        }
    }

    MeshScanner in_;
    VtkCells cells_;
    bool binary_ = false, of_cells_ = false;
    std::size_t rows_ = 0;
};

constexpr double kVtkTetra = 10, kVtkQuadraticTetra = 24;

}  // namespace

void VtkCells::check_counts() const {
    const std::size_t count = types.size();
    if (count > 0 && offsets.size() != count + 1)
        throw Error(name_, "as many types as cells",
                    std::to_string(count) + " types and " + std::to_string(offsets.size()) +
                        " ends of cells");
    if (!tags.empty() && tags.size() != count)
        throw Error(name_, "a tag for each of " + std::to_string(count) + " cells",
                    std::to_string(tags.size()));
    if (!cell_fibres.empty() && cell_fibres.size() != 3 * count)
        throw Error(name_, "a fibre for each of " + std::to_string(count) + " cells",
                    std::to_string(cell_fibres.size() / 3));
    if (!point_fibres.empty() && point_fibres.size() != points.size())
        throw Error(name_, "a fibre for each of " + std::to_string(points.size() / 3) + " points",
                    std::to_string(point_fibres.size() / 3));
}

/// The direction in a tetrahedron. Those of points may point either way along the fibre.
Vec3 VtkCells::fibre(std::size_t cell, const std::array<long long, 4>& nodes) const {
    const auto at = [](const std::vector<double>& values, std::size_t i) {
        return Vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    };
    if (!cell_fibres.empty()) return at(cell_fibres, cell);
    Vec3 sum = Vec3::Zero();
    for (const long long node : nodes) {
        const auto i = static_cast<std::size_t>(node);
        if (3 * i + 2 >= point_fibres.size())
            return Vec3::Zero();  // an unknown node: told by the builder
        const Vec3 one = at(point_fibres, i);
        sum += one.dot(sum) < 0 ? Vec3(-one) : one;
    }
    return sum;
}

TetMesh VtkCells::finish() {
    check_counts();
    const bool has_fibres = !cell_fibres.empty() || !point_fibres.empty();
    std::vector<Vec3> fibres;
    TetMeshBuilder mesh(name_);
    for (std::size_t i = 0; i + 2 < points.size(); i += 3)
        mesh.add_node(static_cast<long long>(i / 3), {points[i], points[i + 1], points[i + 2]});
    for (std::size_t c = 0; c < types.size(); ++c) {
        const std::string cell = name_ + ", cell " + std::to_string(c + 1);
        if (types[c] == kVtkQuadraticTetra)
            throw Error(cell, "linear tetrahedra with 4 nodes", "a quadratic one with 10");
        const double from = offsets[c], to = offsets[c + 1];
        if (!(from >= 0) || !(to >= from) || to > static_cast<double>(connectivity.size()))
            throw Error(cell, "nodes within the connectivity", "others");
        if (types[c] != kVtkTetra) continue;
        if (to - from != 4)
            throw Error(cell, "4 nodes of a tetrahedron", std::to_string(to - from));
        std::array<long long, 4> nodes{};
        for (std::size_t k = 0; k < 4; ++k) {
            const double node = connectivity[static_cast<std::size_t>(from) + k];
            if (!(node >= 0) || !(node < static_cast<double>(kMostVertices)))
                throw Error(cell, "nodes of the file", "node " + std::to_string(node));
            nodes[k] = static_cast<long long>(node);
        }
        mesh.add_tet(nodes, tags.empty() ? 0 : tag_of(tags[c]));
        if (!has_fibres) continue;
        fibres.push_back(fibre(c, nodes));
        if (!fibres.back().allFinite())
            throw Error(cell, "a finite direction of fibres", "another");
    }
    TetMesh out = mesh.finish();
    out.fibres.resize(static_cast<Eigen::Index>(fibres.size()), 3);
    for (std::size_t t = 0; t < fibres.size(); ++t)
        out.fibres.row(static_cast<Eigen::Index>(t)) = fibres[t].transpose();
    return out;
}

TetMesh read_legacy_vtk(std::string_view bytes, const std::string& name) {
    return LegacyReader(bytes, name).read();
}

}  // namespace risorius::io::detail
