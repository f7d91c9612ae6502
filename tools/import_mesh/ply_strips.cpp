// SPDX-License-Identifier: MIT
#include "tools/import_mesh/ply_strips.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/core/file_reader.h"
#include "risorius/core/json_cursor.h"
#include "tools/import_mesh/scene_reader.h"

namespace risorius::import_mesh {
namespace {

constexpr FileKind kPlyFile{"a mesh file", 1000 * kMegabyte};
constexpr std::string_view kStrips = "tristrips";

enum class Order { kText, kLittle, kBig };
enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

std::size_t size_of(Type type) {
    constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

struct Property {
    std::string name;
    std::optional<Type> count;  ///< of the number before a list; nothing for one value
    Type type;
};
struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};
struct Header {
    Order order = Order::kText;
    std::vector<Element> elements;
    std::size_t end = 0;  ///< where the values begin
};

/// Takes the file apart, value after value.
class Ply {
  public:
    Ply(const std::string& name, const std::vector<std::uint8_t>& bytes)
        : name_(name), bytes_(bytes) {
        read_header();
    }

    geom::PolygonMesh read() {
        for (const Element& element : header_.elements) read_element(element);
        mesh_.group_names = {"default"};
        mesh_.face_group.assign(static_cast<std::size_t>(mesh_.face_count()), 0);
        for (const int vertex : mesh_.corner_vertex) {
            if (texcoords_.empty()) break;
            corner_texcoords_.push_back(texcoords_[static_cast<std::size_t>(vertex)]);
        }
        mesh_.corner_texcoord.resize(static_cast<long>(corner_texcoords_.size()), 2);
        for (std::size_t c = 0; c < corner_texcoords_.size(); ++c)
            mesh_.corner_texcoord.row(static_cast<long>(c)) = corner_texcoords_[c].transpose();
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
        throw NoMesh({name_, expected, found});
    }

    Type type_named(const std::string& name) const {
        static const std::map<std::string, Type> kTypes{
            {"char", Type::kInt8},     {"int8", Type::kInt8},     {"uchar", Type::kUint8},
            {"uint8", Type::kUint8},   {"short", Type::kInt16},   {"int16", Type::kInt16},
            {"ushort", Type::kUint16}, {"uint16", Type::kUint16}, {"int", Type::kInt32},
            {"int32", Type::kInt32},   {"uint", Type::kUint32},   {"uint32", Type::kUint32},
            {"float", Type::kFloat},   {"float32", Type::kFloat}, {"double", Type::kDouble},
            {"float64", Type::kDouble}};
        const auto found = kTypes.find(name);
        if (found == kTypes.end()) fail("a type of PLY in the header", "\"" + name + "\"");
        return found->second;
    }

    void read_header() {
        const std::string_view text(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            std::istringstream words(std::string(text.substr(begin, end - begin)));
            begin = end + 1;
            std::string key, first;
            words >> key >> first;
            if (key == "end_header") {
                at_ = std::min(begin, text.size());
                return;
            }
            if (key == "format") {
                header_.order = first == "binary_little_endian" ? Order::kLittle
                                : first == "binary_big_endian"  ? Order::kBig
                                                                : Order::kText;
            } else if (key == "element") {
                header_.elements.push_back({first, 0, {}});
                if (!(words >> header_.elements.back().count))
                    fail("a number of elements in the header", "\"" + first + "\" without one");
            } else if (key == "property") {
                if (header_.elements.empty()) fail("an element before its properties", "none");
                read_property(first, words);
            }
        }
        fail("the line end_header", "none");
    }

    void read_property(const std::string& first, std::istringstream& words) {
        Property property;
        std::string type = first;
        if (first == "list") {
            std::string count;
            words >> count >> type;
            property.count = type_named(count);
        }
        property.type = type_named(type);
        if (!(words >> property.name)) fail("a name after the type of a property", "none");
        header_.elements.back().properties.push_back(property);
    }

    double number(Type type) {
        if (header_.order == Order::kText) return number_in_text();
        const std::size_t size = size_of(type);
        if (size > bytes_.size() - at_) fail("values to the end of the last element", "less");
        std::array<std::uint8_t, 8> own{};
        std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), size, own.begin());
        if (header_.order == Order::kBig) std::reverse(own.begin(), own.begin() + size);
        at_ += size;
        switch (type) {
            case Type::kInt8:
                return value<std::int8_t>(own);
            case Type::kUint8:
                return value<std::uint8_t>(own);
            case Type::kInt16:
                return value<std::int16_t>(own);
            case Type::kUint16:
                return value<std::uint16_t>(own);
            case Type::kInt32:
                return value<std::int32_t>(own);
            case Type::kUint32:
                return value<std::uint32_t>(own);
            case Type::kFloat:
                return value<float>(own);
            case Type::kDouble:
                return value<double>(own);
        }
        return 0;
    }

    template <typename Value>
    static double value(const std::array<std::uint8_t, 8>& bytes) {
        Value out;
        std::memcpy(&out, bytes.data(), sizeof out);
        return static_cast<double>(out);
    }

    double number_in_text() {
        while (at_ < bytes_.size() && bytes_[at_] <= ' ') ++at_;
        if (at_ < bytes_.size() && bytes_[at_] == '+') ++at_;
        const char* begin = reinterpret_cast<const char*>(bytes_.data()) + at_;
        const char* end = reinterpret_cast<const char*>(bytes_.data()) + bytes_.size();
        double out = 0;
        const auto [next, problem] = std::from_chars(begin, end, out);
        if (begin == end) fail("values to the end of the last element", "less");
        if (problem != std::errc()) fail("numbers after the header", "text");
        at_ += static_cast<std::size_t>(next - begin);
        return out;
    }

    /// The number of values in a list, each of which takes at least a byte.
    std::size_t length(Type type) {
        const double count = number(type);
        if (!(count >= 0 && count <= static_cast<double>(bytes_.size() - at_)))
            fail("lists that end within the file", "a longer one");
        return static_cast<std::size_t>(count);
    }

    void read_element(const Element& element) {
        if (element.count > 0 && element.properties.empty())
            fail("properties of " + element.name, "none");
        for (std::size_t i = 0; i < element.count; ++i) {
            std::array<double, 3> position{};
            std::array<double, 2> texcoord{};
            bool textured = false;
            for (const Property& property : element.properties) {
                if (property.count) {
                    read_list(element.name, property);
                    continue;
                }
                const double read = number(property.type);
                static const std::map<std::string, int> kPlaces{
                    {"x", 0}, {"y", 1}, {"z", 2},         {"s", 3},        {"t", 4},
                    {"u", 3}, {"v", 4}, {"texture_u", 3}, {"texture_v", 4}};
                const auto place = kPlaces.find(property.name);
                if (place == kPlaces.end()) continue;
                textured |= place->second > 2;
                (place->second < 3 ? position[static_cast<std::size_t>(place->second)]
                                   : texcoord[static_cast<std::size_t>(place->second - 3)]) = read;
            }
            if (element.name != "vertex") continue;
            positions_.emplace_back(position[0], position[1], position[2]);
            if (textured) texcoords_.emplace_back(texcoord[0], texcoord[1]);
        }
        if (element.name != "vertex") return;
        mesh_.positions.resize(static_cast<long>(positions_.size()), 3);
        for (std::size_t v = 0; v < positions_.size(); ++v)
            mesh_.positions.row(static_cast<long>(v)) = positions_[v].transpose();
    }

    void read_list(const std::string& element, const Property& property) {
        const bool indices = (element == kStrips || element == "face") &&
                             (property.name == "vertex_indices" || property.name == "vertex_index");
        const std::size_t count = length(*property.count);
        std::vector<int> own;
        for (std::size_t k = 0; k < count; ++k) {
            const double index = number(property.type);
            if (!indices) continue;
            if (index < 0 && element == kStrips) {
                add_strip(own);
                own.clear();
            } else if (!(index >= 0 && index < static_cast<double>(mesh_.positions.rows()))) {
                fail("vertices in 0 .. " + std::to_string(mesh_.positions.rows() - 1),
                     format_number(index));
            } else {
                own.push_back(static_cast<int>(index));
            }
        }
        if (!indices) return;
        if (element == kStrips) return add_strip(own);
        if (own.size() >= 3) add_face(own);
    }

    void add_strip(const std::vector<int>& strip) {
        for (std::size_t k = 2; k < strip.size(); ++k) {
            const int a = strip[k - 2], b = strip[k - 1], c = strip[k];
            if (a == b || b == c || a == c) continue;
            // Every second triangle runs the other way round.
            if (k % 2 == 0)
                add_face({a, b, c});
            else
                add_face({b, a, c});
        }
    }
    void add_face(const std::vector<int>& vertices) {
        mesh_.corner_vertex.insert(mesh_.corner_vertex.end(), vertices.begin(), vertices.end());
        mesh_.face_begin.push_back(static_cast<int>(mesh_.corner_vertex.size()));
    }

    const std::string& name_;
    const std::vector<std::uint8_t>& bytes_;
    Header header_;
    std::size_t at_ = 0;
    std::vector<Vec3> positions_;
    std::vector<Vec2> texcoords_, corner_texcoords_;
    geom::PolygonMesh mesh_;
};

}  // namespace

bool has_strips(const std::filesystem::path& file) {
    constexpr std::size_t kLongestHeader = 1 << 16;
    std::string header(kLongestHeader, '\0');
    FileReader in(file, kPlyFile);
    header.resize(in.read(header.data(), header.size()));
    header.resize(std::min(header.find("end_header"), header.size()));
    return header.find("element " + std::string(kStrips)) != std::string::npos;
}

geom::PolygonMesh read_ply_with_strips(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = read_bytes(file, kPlyFile);
    geom::PolygonMesh mesh = Ply(file.string(), bytes).read();
    if (mesh.face_count() == 0) throw NoMesh({file.string(), "faces", "none"});
    return mesh;
}

}  // namespace risorius::import_mesh
