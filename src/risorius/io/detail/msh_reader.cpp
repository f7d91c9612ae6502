// SPDX-License-Identifier: MIT
// Gmsh .msh, versions 2 and 4.1. Source: Gmsh reference manual 4.12, "MSH file format".
#include <array>
#include <bit>
#include <map>

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
        return mesh_.finish();
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
                integer("the number of an element", 0, kLargestTag);
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
                read_nodes_of(type, physical != 0 ? physical : entity,
                              [&] { return integer("a node", 0, kLargestTag); });
            }
        }
    }

    template <class Next>
    void read_nodes_of(long long type, int tag, const Next& next) {
        const int nodes = kNodesOfType[static_cast<std::size_t>(type)];
        if (type == 11) in_.fail("linear tetrahedra with 4 nodes", "quadratic ones with 10");
        std::array<long long, 4> tet{};
        for (int k = 0; k < nodes; ++k) {
            const long long node = next();
            if (k < 4) tet[static_cast<std::size_t>(k)] = node;
        }
        if (type == kLinearTet) mesh_.add_tet(tet, tag);
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
                whole("the number of an element", kLargestId);
                read_nodes_of(type, group == physical_.end() ? entity : group->second,
                              [&] { return whole("a node", kLargestId); });
            }
        }
    }

    MeshScanner in_;
    TetMeshBuilder mesh_;
    bool binary_ = false, swapped_ = false, four_ = false;
    std::map<int, int> physical_;  ///< of each volume
};

}  // namespace

TetMesh read_msh(std::string_view bytes, const std::string& name) {
    return MshReader(bytes, name).read();
}

}  // namespace risorius::io::detail
