// SPDX-License-Identifier: MIT
#include "risorius/io/detail/obj_textures.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "risorius/core/error.h"
#include "risorius/core/text_lines.h"
#include "risorius/io/detail/mesh_limits.h"
#include "risorius/io/detail/picture_place.h"

namespace risorius::io::detail {
namespace {

constexpr std::string_view kBlank = " \t";
constexpr std::size_t kMostLibraries = 100;

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string_view first_word(std::string_view text) {
    return text.substr(0, text.find_first_of(kBlank));
}

/// Takes the first word off a text.
std::string_view take_word(std::string_view& text) {
    const std::string_view word = first_word(text);
    text = trimmed(text.substr(word.size()));
    return word;
}

bool is_number(std::string_view word, double& value) {
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    return problem == std::errc() && end == word.data() + word.size();
}

/// The name of a picture after the options of "map_Kd". `moved_by` receives the option that moves it over the surface.
std::string picture_name(std::string_view rest, std::string& moved_by) {
    static const std::map<std::string_view, int> kValuesOf{
        {"-blendu", 1}, {"-blendv", 1}, {"-cc", 1},      {"-clamp", 1}, {"-boost", 1},
        {"-mm", 2},     {"-texres", 1}, {"-imfchan", 1}, {"-bm", 1},    {"-type", 1}};
    // One to three numbers each, and the number that moves nothing
    static const std::map<std::string_view, double> kIdentity{{"-o", 0}, {"-s", 1}, {"-t", 0}};
    rest = trimmed(rest);
    while (rest.starts_with('-')) {
        const std::string_view option = take_word(rest);
        if (const auto moving = kIdentity.find(option); moving != kIdentity.end()) {
            double value = 0;
            for (int i = 0; i < 3 && is_number(first_word(rest), value); ++i) {
                if (value != moving->second) moved_by = option;
                take_word(rest);
            }
        } else if (const auto values = kValuesOf.find(option); values != kValuesOf.end()) {
            for (int i = 0; i < values->second; ++i) take_word(rest);
        } else {
            moved_by = option;
            return {};
        }
    }
    return std::string(rest);
}

/// Adds the picture of each material of an MTL file. A picture that cannot be laid on is no reason to refuse the shape.
void read_library(const std::filesystem::path& file, std::map<std::string, geom::Texture>& textures,
                  std::vector<std::string>& notes) {
    check_file(file, kMaterialFile);
    const std::string text = read_text(file, kMaterialFile);
    std::string material;
    PicturePlaces places;
    for (TextLines lines(text); lines.next();) {
        std::string_view rest = trimmed(lines.line());
        const std::string_view key = take_word(rest);
        if (key == "newmtl") material = rest;
        if (key != "map_Kd") continue;
        const std::string place = file.string() + ":" + std::to_string(lines.number());
        std::string moved_by;
        const std::string name = picture_name(rest, moved_by);
        const auto leave_out = [&](const std::string& why) {
            if (notes.size() < kMostNotes) notes.push_back(place + ": " + why);
        };
        if (!moved_by.empty())
            leave_out("the picture is left out, because " + in_quotes(moved_by) +
                      " moves it over the texture coordinates");
        else if (name.empty())
            leave_out("\"map_Kd\" names no picture");
        else
            textures[material] = {places.find(file.parent_path(), name), place, {}};
    }
}

}  // namespace

void add_obj_textures(const std::filesystem::path& obj, const ObjMaterials& materials,
                      geom::PolygonMesh& mesh) {
    std::map<std::string, geom::Texture> pictures;
    std::set<std::filesystem::path> read;
    for (const std::string& library : materials.libraries) {
        std::error_code problem;
        const auto named = obj.parent_path() / library;
        if (!std::filesystem::exists(named, problem)) continue;
        // A library may be named in many ways.
        const auto file = std::filesystem::canonical(named, problem);
        if (problem || read.size() == kMostLibraries || !read.insert(file).second) continue;
        try {
            read_library(named, pictures, mesh.notes);
        } catch (const Error& error) {
            mesh.notes.push_back(std::string(error.what()) + "; its pictures are left out");
        }
    }
    std::map<std::filesystem::path, int> index;
    std::vector<int> texture_of_material;
    for (const std::string& name : materials.names) {
        const auto found = pictures.find(name);
        texture_of_material.push_back(-1);
        if (found == pictures.end()) continue;
        const auto [known, is_new] =
            index.try_emplace(found->second.file, static_cast<int>(mesh.textures.size()));
        texture_of_material.back() = known->second;
        if (is_new) mesh.textures.push_back(found->second);
    }
    if (mesh.textures.empty()) return;
    for (const int material : materials.of_face)
        mesh.face_texture.push_back(
            material < 0 ? -1 : texture_of_material[static_cast<std::size_t>(material)]);
}

}  // namespace risorius::io::detail
