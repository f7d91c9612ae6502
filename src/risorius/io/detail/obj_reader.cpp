// SPDX-License-Identifier: MIT
#include "risorius/io/detail/obj_reader.h"

#include <array>
#include <charconv>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/readable_text.h"
#include "risorius/core/text_lines.h"
#include "risorius/io/detail/mesh_limits.h"

namespace risorius::io::detail {
namespace {

constexpr int kNoTexCoord = -1;
const std::string kDefaultGroup = "default";  // the format's name for faces before any "g"

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// The text at an error in the file, shortened.
std::string in_quotes(std::string_view text) { return "\"" + shortened_text(text, 24) + "\""; }

/// Keys that are followed by a name, in which a '#' is a letter like others.
bool takes_a_name(std::string_view key) {
    return key == "g" || key == "o" || key == "usemtl" || key == "mtllib";
}

class ObjReader {
  public:
    ObjReader(const std::string& text, const std::string& name) : lines_(text), name_(name) {}

    geom::PolygonMesh read() {
        std::string joined;
        while (lines_.next()) {
            std::string_view line = trimmed(lines_.line());
            std::string_view rest = line;
            const std::string_view key = next_word(rest);
            // A comment ends with its line, whatever stands last in it.
            if (key.empty() || key.front() == '#') continue;
            const bool named = takes_a_name(key);
            line_ = static_cast<int>(lines_.number());
            if (!named) line = without_comment(line);
            // A backslash at the end of a line continues it on the next line.
            if (!line.empty() && line.back() == '\\') {
                joined.assign(line.substr(0, line.size() - 1));
                while (lines_.next()) {
                    std::string_view more = trimmed(lines_.line());
                    if (!named) more = without_comment(more);
                    const bool goes_on = !more.empty() && more.back() == '\\';
                    joined += ' ';
                    joined += more.substr(0, more.size() - (goes_on ? 1 : 0));
                    if (!goes_on) break;
                }
                line = joined;
            }
            read_statement(line);
        }
        return finish();
    }

    ObjMaterials take_materials() {
        return {std::move(libraries_), std::move(material_names_), std::move(face_material_)};
    }

  private:
    static std::string_view trimmed(std::string_view line) {
        while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
        return line;
    }
    static std::string_view without_comment(std::string_view line) {
        return trimmed(line.substr(0, line.find('#')));
    }

    static std::string_view next_word(std::string_view& rest) {
        std::size_t begin = 0;
        while (begin < rest.size() && is_blank(rest[begin])) ++begin;
        std::size_t end = begin;
        while (end < rest.size() && !is_blank(rest[end])) ++end;
        const std::string_view word = rest.substr(begin, end - begin);
        rest.remove_prefix(end);
        return word;
    }

    [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
        throw Error(name_ + ":" + std::to_string(line_), expected, found);
    }

    void read_statement(std::string_view rest) {
        const std::string_view key = next_word(rest);
        if (key == "v") {
            if (positions_.size() == kMostVertices) fail(kFewerVertices, "more");
            std::array<double, 3> p;
            read_numbers(rest, p.data(), 3, "three coordinates after \"v\"");
            positions_.push_back(p);
        } else if (key == "vt") {
            if (texcoords_.size() == kMostCorners) fail(kFewerCorners, "more");
            std::array<double, 2> t{0.0, 0.0};
            read_numbers(rest, t.data(), 2, "two coordinates after \"vt\"");
            texcoords_.push_back(t);
        } else if (key == "f") {
            read_face(rest);
        } else if (key == "g" || key == "o") {
            has_groups_ = true;
            group_ = group_named(rest, group_names_, group_of_name_);
        } else if (key == "usemtl") {
            material_ = group_named(rest, material_names_, material_of_name_);
        } else if (key == "mtllib") {
            while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
            while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
            // A file may name its library before each object.
            if (seen_libraries_.emplace(rest).second) libraries_.emplace_back(rest);
        } else if (stranger_.empty() && key != "vn" && key != "s") {
            stranger_ = in_quotes(key);
            stranger_line_ = line_;
        }
    }

    void read_numbers(std::string_view rest, double* out, int count, const char* expected) {
        for (int k = 0; k < count; ++k) {
            std::string_view word = next_word(rest);
            if (word.empty()) fail(expected, std::to_string(k));
            const std::string_view whole = word;
            if (word.front() == '+') word.remove_prefix(1);
            const auto [end, problem] =
                std::from_chars(word.data(), word.data() + word.size(), out[k]);
            if (problem == std::errc::result_out_of_range)
                fail("a number that a double can hold", in_quotes(whole));
            if (problem != std::errc() || end != word.data() + word.size())
                fail(whole.find(',') == std::string_view::npos
                         ? "a number"
                         : "a number with a point before its decimals",
                     in_quotes(whole));
        }
    }

    /// OBJ counts from 1; negative indices count backwards from the latest element.
    int resolve(int index, std::size_t count, const char* what) const {
        const int n = static_cast<int>(count);
        const int resolved = index > 0 ? index - 1 : n + index;
        if (index == 0 || resolved < 0)
            fail(std::string("the index of a ") + what + " (from 1, or back from -1)",
                 std::to_string(index));
        return resolved;
    }

    /// The index at the start of a text; `at` goes behind it.
    static bool read_index(const char*& at, const char* end, int& value) {
        if (at != end && *at == '+') ++at;
        const auto [behind, problem] = std::from_chars(at, end, value);
        at = behind;
        return problem == std::errc();
    }

    void read_face(std::string_view rest) {
        int corners = 0;
        const std::size_t first = corner_vertex_.size();
        for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
            if (corner_vertex_.size() == kMostCorners) fail(kFewerCorners, "more");
            const char *at = word.data(), *const end = at + word.size();
            int vertex = 0, texcoord = 0;
            if (!read_index(at, end, vertex))
                fail("a face corner v, v/vt, v//vn or v/vt/vn", in_quotes(word));
            corner_vertex_.push_back(resolve(vertex, positions_.size(), "vertex"));
            int corner_texcoord = kNoTexCoord;
            if (at != end && *at == '/' && at + 1 != end && at[1] != '/') {
                if (!read_index(++at, end, texcoord))
                    fail("a face corner v, v/vt, v//vn or v/vt/vn", in_quotes(word));
                corner_texcoord = resolve(texcoord, texcoords_.size(), "texture coordinate");
            }
            if (at != end && *at != '/')
                fail("a face corner v, v/vt, v//vn or v/vt/vn", in_quotes(word));
            corner_texcoord_.push_back(corner_texcoord);
            ++corners;
        }
        if (corners < 2) fail("a face of at least three corners", std::to_string(corners));
        if (corners == 2) {
            // Some programs write edges this way.
            if (edges_++ == 0) edge_line_ = line_;
            corner_vertex_.resize(first);
            corner_texcoord_.resize(first);
            return;
        }
        face_begin_.push_back(static_cast<int>(corner_vertex_.size()));
        face_line_.push_back(line_);
        face_group_.push_back(group_);
        face_material_.push_back(material_);
    }

    /// A "g" line may list several names. They stay one name with spaces, as written.
    static int group_named(std::string_view rest, std::vector<std::string>& names,
                           std::unordered_map<std::string, int>& index) {
        while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
        const std::string name = rest.empty() ? kDefaultGroup : std::string(rest);
        const auto [entry, is_new] = index.try_emplace(name, static_cast<int>(names.size()));
        if (is_new) names.push_back(name);
        return entry->second;
    }

    geom::PolygonMesh finish() {
        if (positions_.empty() || face_line_.empty()) {
            const std::string expected =
                positions_.empty() ? "vertices (\"v x y z\")" : "faces (\"f a b c\")";
            if (stranger_.empty()) throw Error(name_, expected, "none");
            throw Error(
                name_, expected,
                "none (line " + std::to_string(stranger_line_) + " begins with " + stranger_ + ")");
        }
        // An index may point to an element after its face, so the upper limit is only known now.
        const int vertex_count = static_cast<int>(positions_.size());
        const int texcoord_count = static_cast<int>(texcoords_.size());
        bool any_texcoord = false;
        for (std::size_t face = 0; face < face_line_.size(); ++face)
            for (int c = face_begin_[face]; c < face_begin_[face + 1]; ++c) {
                line_ = face_line_[face];
                if (corner_vertex_[c] >= vertex_count)
                    fail("a vertex index of at most " + std::to_string(vertex_count),
                         std::to_string(corner_vertex_[c] + 1));
                if (corner_texcoord_[c] >= texcoord_count)
                    fail("a texture coordinate index of at most " + std::to_string(texcoord_count),
                         std::to_string(corner_texcoord_[c] + 1));
                any_texcoord |= corner_texcoord_[c] != kNoTexCoord;
            }

        geom::PolygonMesh mesh;
        mesh.positions.resize(vertex_count, 3);
        for (int v = 0; v < vertex_count; ++v)
            for (int k = 0; k < 3; ++k) mesh.positions(v, k) = positions_[v][k];
        if (any_texcoord) {
            mesh.corner_texcoord.setZero(static_cast<long>(corner_vertex_.size()), 2);
            for (std::size_t c = 0; c < corner_vertex_.size(); ++c)
                if (corner_texcoord_[c] != kNoTexCoord)
                    for (int k = 0; k < 2; ++k)
                        mesh.corner_texcoord(static_cast<long>(c), k) =
                            texcoords_[corner_texcoord_[c]][k];
        }
        mesh.face_begin = std::move(face_begin_);
        mesh.corner_vertex = std::move(corner_vertex_);
        name_groups(mesh);
        if (edges_ > 0)
            mesh.notes.push_back(
                name_ + ":" + std::to_string(edge_line_) + ": " +
                (edges_ == 1 ? std::string("a face of two corners is an edge")
                             : std::to_string(edges_) + " faces of two corners are edges") +
                ", left out");
        return mesh;
    }

    /// Sorts groups by their first face. A name without faces is not a group.
    void name_groups(geom::PolygonMesh& mesh) const {
        const bool by_material = !has_groups_ && !material_names_.empty();
        if (has_groups_ && !material_names_.empty()) {
            mesh.material_names = material_names_;
            mesh.face_material = face_material_;
        }
        const std::vector<std::string>& names = by_material ? material_names_ : group_names_;
        std::unordered_map<std::string, int> seen;
        for (const int named : by_material ? face_material_ : face_group_) {
            const std::string& name = named == kUnnamed ? kDefaultGroup : names[named];
            const auto [entry, is_new] =
                seen.try_emplace(name, static_cast<int>(mesh.group_names.size()));
            if (is_new) mesh.group_names.push_back(name);
            mesh.face_group.push_back(entry->second);
        }
    }

    static constexpr int kUnnamed = -1;

    TextLines lines_;
    std::string name_;
    int line_ = 0;  ///< of the statement
    int edges_ = 0, edge_line_ = 0;
    std::vector<std::array<double, 3>> positions_;
    std::vector<std::array<double, 2>> texcoords_;
    std::vector<int> face_begin_{0}, face_line_, face_group_, face_material_;
    std::vector<int> corner_vertex_, corner_texcoord_;
    bool has_groups_ = false;
    int group_ = kUnnamed, material_ = kUnnamed;
    std::vector<std::string> group_names_, material_names_, libraries_;
    std::unordered_map<std::string, int> group_of_name_, material_of_name_;
    std::unordered_set<std::string> seen_libraries_;
    std::string stranger_;
    int stranger_line_ = 0;
};

}  // namespace

geom::PolygonMesh read_obj(const std::string& text, const std::string& name,
                           ObjMaterials* materials) {
    ObjReader reader(text, name);
    geom::PolygonMesh mesh = reader.read();
    if (materials) *materials = reader.take_materials();
    return mesh;
}

}  // namespace risorius::io::detail
