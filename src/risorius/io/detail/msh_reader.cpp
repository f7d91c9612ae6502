// SPDX-License-Identifier: MIT
// Gmsh .msh, versions 2 and 4.1. Source: Gmsh reference manual 4.12, "MSH file format".
#include <array>
#include <bit>
#include <map>
#include <unordered_map>

#include "risorius/io/detail/mesh_limits.h"
#include "risorius/io/detail/mesh_scanner.h"
#include "risorius/io/detail/tet_mesh_builder.h"

namespace risorius::io::detail {

namespace {

/// Nodes of the linear and quadratic elements of Gmsh by their type; 0: unknown.
constexpr std::array<int, 20> kNodesOfType{0, 2,  3,  4,  4,  8, 6, 5,  3,  6,
                                           9, 10, 27, 18, 14, 1, 8, 20, 15, 13};
constexpr long long kLinearTet = 4;
constexpr long long kMostTags = 1000;
constexpr int kLargestTag = 2'147'483'647;

class MshReader {
  public:
    MshReader(std::string_view bytes, const std::string& name) : in_(bytes, name), mesh_(name) {}

    TetMesh read() {
        in_.expect("$MeshFormat");
        const std::string version(in_.word());
        binary_ = in_.integer("0 for text or 1 for binary", 0, 1) == 1;
        in_.integer("the size of a number, 8", 8, 8);
        if (version != "4.1" && !version.starts_with("2"))
            in_.fail("version 2 or 4.1 of the format", version);
        four_ = version == "4.1";
        in_.line();
        if (binary_) {
            const auto one = in_.numbers(1, Scalar::kInt32, false, "the integer 1").front();
            swapped_ = one != 1;
            if (swapped_ && one != 16777216) in_.fail("the integer 1", std::to_string(one));
        }
        in_.expect("$EndMeshFormat");
        for (std::string_view section = in_.word(); !section.empty(); section = in_.word())
            read_section(std::string(section));
        TetMesh out = mesh_.finish();
        if (!fibres_.empty()) out.fibres = fibres_in_order();
        return out;
    }

  private:
    void read_section(const std::string& section) {
        if (!section.starts_with("$")) in_.fail("a section, as $Nodes", section.substr(0, 24));
        if (section == "$PhysicalNames")
            read_names();
        else if (section == "$Entities" && four_)
            read_entities();
        else if (section == "$Nodes")
            four_ ? read_nodes_4() : read_nodes_2();
        else if (section == "$Elements")
            four_ ? read_elements_4() : read_elements_2();
        else if (section == "$ElementData")
            read_data();
        else
            return skip(section);
        in_.expect("$End" + section.substr(1));
    }

    void skip(const std::string& section) {
        const std::string end = "$End" + section.substr(1);
        while (in_.left() > 0)
            if (in_.line() == end) return;
        in_.fail(end, "the end of the file");
    }

    // Numbers of either form
    double real(std::string_view what) {
        return binary_ ? in_.numbers(1, Scalar::kDouble, swapped_, what).front() : in_.number(what);
    }
    long long integer(std::string_view what, long long min, long long max) {
        return binary_ ? in_.binary_integer(Scalar::kInt32, swapped_, what, min, max)
                       : in_.integer(what, min, max);
    }
    /// size_t of version 4
    long long whole(std::string_view what, long long max) {
        return binary_ ? in_.binary_integer(Scalar::kUInt64, swapped_, what, 0, max)
                       : in_.integer(what, 0, max);
    }
    /// A count of things that take so many bytes at least.
    std::size_t held(std::string_view what, std::size_t text_bytes, std::size_t binary_bytes) {
        const auto count =
            static_cast<std::size_t>(whole("the number of " + std::string(what), kLargestId));
        if (count > (in_.left() + 1) / (binary_ ? binary_bytes : text_bytes))
            in_.fail(
                "as many bytes as " + std::to_string(count) + " " + std::string(what) + " take",
                std::to_string(in_.left()));
        return count;
    }
    /// In binary files a line break ends the line before the numbers.
    void begin_block() {
        if (binary_) in_.line();
    }

    void read_names() {
        const std::size_t count = in_.count("names", 4, kMostVertices);
        for (std::size_t i = 0; i < count; ++i) {
            const long long dimension = in_.integer("the dimension", 0, 3);
            const auto tag = static_cast<int>(in_.integer("the tag", -kLargestTag, kLargestTag));
            std::string name(in_.line());
            const std::size_t from = name.find('"'), to = name.rfind('"');
            if (from == std::string::npos || to <= from) in_.fail("a name in quotes", name);
            if (dimension == 3) mesh_.names()[name.substr(from + 1, to - from - 1)] = tag;
        }
    }

    // Version 2

    void read_nodes_2() {
        const std::size_t count = in_.count("nodes", binary_ ? 28 : 8, kMostVertices);
        begin_block();
        for (std::size_t i = 0; i < count; ++i) {
            const long long id = integer("the number of a node", 0, kLargestTag);
            Vec3 at;
            for (int k = 0; k < 3; ++k) at[k] = real("a coordinate");
            mesh_.add_node(id, at);
        }
    }

    void read_elements_2() {
        const std::size_t count = in_.count("elements", binary_ ? 4 : 4, 4 * kMostTets);
        begin_block();
        std::size_t done = 0;
        while (done < count) {
            long long type = 0, in_block = 1, tags = 0;
            if (binary_) {
                type = integer("the type of elements", 1, kNodesOfType.size() - 1);
                in_block =
                    integer("the number of elements", 1, static_cast<long long>(count - done));
                tags = integer("the number of tags", 0, kMostTags);
            }
            for (long long e = 0; e < in_block; ++e, ++done) {
                const long long id = integer("the number of an element", 0, kLargestTag);
                if (!binary_) {
                    type = integer("the type of an element", 1, kNodesOfType.size() - 1);
                    tags = integer("the number of tags", 0, kMostTags);
                }
                int physical = 0, entity = 0;
                for (long long t = 0; t < tags; ++t) {
                    const auto tag = static_cast<int>(integer("a tag", -kLargestTag, kLargestTag));
                    if (t == 0) physical = tag;
                    if (t == 1) entity = tag;
                }
                read_nodes_of(id, type, physical != 0 ? physical : entity,
                              [&] { return integer("a node", 0, kLargestTag); });
            }
        }
    }

    template <class Next>
    void read_nodes_of(long long id, long long type, int tag, const Next& next) {
        const int nodes = kNodesOfType[static_cast<std::size_t>(type)];
        if (type == 11) in_.fail("linear tetrahedra with 4 nodes", "quadratic ones with 10");
        std::array<long long, 4> tet{};
        for (int k = 0; k < nodes; ++k) {
            const long long node = next();
            if (k < 4) tet[static_cast<std::size_t>(k)] = node;
        }
        if (type != kLinearTet) return;
        mesh_.add_tet(tet, tag);
        ids_.push_back(id);
    }

    /// Directions of fibres are data of elements with three components. Other data are left out. Both versions write them in this way.
    void read_data() {
        in_.line();
        std::string name;
        const std::size_t strings = in_.count("strings", 2, kMostTags);
        in_.line();
        for (std::size_t i = 0; i < strings; ++i) {
            const std::string text(in_.line());
            if (i > 0) continue;
            const std::size_t from = text.find('"'), to = text.rfind('"');
            if (from == std::string::npos || to <= from) in_.fail("a name in quotes", text);
            name = text.substr(from + 1, to - from - 1);
        }
        const std::size_t reals = in_.count("real tags", 2, kMostTags);
        for (std::size_t i = 0; i < reals; ++i) in_.number("a real tag");
        const std::size_t integers = in_.count("integer tags", 2, kMostTags);
        if (integers < 3) in_.fail("the step, components and elements", "fewer integer tags");
        in_.integer("the step", -kLargestTag, kLargestTag);
        const auto components =
            static_cast<std::size_t>(in_.integer("the number of components", 1, 9));
        const std::size_t count =
            in_.count("elements", binary_ ? 4 + 8 * components : 2 + 2 * components, 4 * kMostTets);
        for (std::size_t i = 3; i < integers; ++i)
            in_.integer("an integer tag", -kLargestTag, kLargestTag);
        const bool wanted = components == 3 && is_fibre_name(name);
        if (wanted && !fibres_.empty()) in_.fail("one field of fibres", "another");
        begin_block();
        for (std::size_t e = 0; e < count; ++e) {
            const long long id = integer("the number of an element", 0, kLargestTag);
            Vec3 value = Vec3::Zero();
            for (std::size_t k = 0; k < components; ++k) {
                const double one = real("a component");
                if (k < 3) value[static_cast<Eigen::Index>(k)] = one;
            }
            if (!wanted) continue;
            if (!value.allFinite()) in_.fail("a finite direction of fibres", "another");
            fibres_[id] = value;
        }
    }

    /// One row per tetrahedron; 0 where the field has none.
    Points fibres_in_order() const {
        Points out = Points::Zero(static_cast<Eigen::Index>(ids_.size()), 3);
        for (std::size_t t = 0; t < ids_.size(); ++t)
            if (const auto found = fibres_.find(ids_[t]); found != fibres_.end())
                out.row(static_cast<Eigen::Index>(t)) = found->second.transpose();
        return out;
    }

    // Version 4

    void read_entities() {
        begin_block();
        std::array<std::size_t, 4> counts{};
        for (std::size_t& count : counts) count = held("entities", 8, 32);
        for (std::size_t dimension = 0; dimension < 4; ++dimension)
            for (std::size_t i = 0; i < counts[dimension]; ++i) {
                const auto tag = static_cast<int>(integer("an entity", -kLargestTag, kLargestTag));
                for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) real("a bound");
                const std::size_t groups = held("physical groups", 2, 4);
                for (std::size_t g = 0; g < groups; ++g) {
                    const auto group =
                        static_cast<int>(integer("a physical group", -kLargestTag, kLargestTag));
                    if (dimension == 3 && g == 0) physical_[tag] = group;
                }
                if (dimension == 0) continue;
                const std::size_t bounds = held("bounding entities", 2, 4);
                for (std::size_t b = 0; b < bounds; ++b)
                    integer("a bounding entity", -kLargestTag, kLargestTag);
            }
    }

    void read_nodes_4() {
        begin_block();
        const std::size_t blocks = held("blocks of nodes", 8, 20);
        whole("the number of nodes", kLargestId);
        whole("the least node", kLargestId);
        whole("the largest node", kLargestId);
        std::vector<long long> ids;
        for (std::size_t b = 0; b < blocks; ++b) {
            const long long dimension = integer("the dimension of an entity", 0, 3);
            integer("an entity", -kLargestTag, kLargestTag);
            const bool parametric = integer("0, or 1 for parametric nodes", 0, 1) == 1;
            const std::size_t count = held("nodes", 8, 32);
            ids.clear();
            for (std::size_t i = 0; i < count; ++i) ids.push_back(whole("a node", kLargestId));
            for (std::size_t i = 0; i < count; ++i) {
                Vec3 at;
                for (int k = 0; k < 3; ++k) at[k] = real("a coordinate");
                for (long long k = 0; parametric && k < dimension; ++k) real("a parameter");
                mesh_.add_node(ids[i], at);
            }
        }
    }

    void read_elements_4() {
        begin_block();
        const std::size_t blocks = held("blocks of elements", 8, 20);
        whole("the number of elements", kLargestId);
        whole("the least element", kLargestId);
        whole("the largest element", kLargestId);
        for (std::size_t b = 0; b < blocks; ++b) {
            integer("the dimension of an entity", 0, 3);
            const auto entity = static_cast<int>(integer("an entity", -kLargestTag, kLargestTag));
            const long long type = integer("the type of elements", 1, kNodesOfType.size() - 1);
            const std::size_t count = held("elements", 4, 16);
            const auto group = physical_.find(entity);
            for (std::size_t e = 0; e < count; ++e) {
                const long long id = whole("the number of an element", kLargestId);
                read_nodes_of(id, type, group == physical_.end() ? entity : group->second,
                              [&] { return whole("a node", kLargestId); });
            }
        }
    }

    MeshScanner in_;
    TetMeshBuilder mesh_;
    bool binary_ = false, swapped_ = false, four_ = false;
    std::map<int, int> physical_;                           ///< of each volume
    std::vector<long long> ids_;                            ///< of the tetrahedra
    std::unordered_map<long long, Vec3, NodeHash> fibres_;  ///< of elements
};

}  // namespace

TetMesh read_msh(std::string_view bytes, const std::string& name) {
    return MshReader(bytes, name).read();
}

}  // namespace risorius::io::detail
