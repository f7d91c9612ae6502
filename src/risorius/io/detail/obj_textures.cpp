// SPDX-License-Identifier: MIT
#include "risorius/io/detail/obj_textures.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "risorius/core/error.h"

namespace risorius::io::detail {
namespace {

constexpr const char* kBlank = " \t\r";

std::string trimmed(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(kBlank);
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// The name of a picture after the options of "map_Kd". Options that would move it over the surface are rejected.
std::string picture_name(std::string rest, const std::string& place) {
    static const std::map<std::string, int> kValuesOf{{"-blendu", 1}, {"-blendv", 1},  {"-cc", 1},
                                                      {"-clamp", 1},  {"-boost", 1},   {"-mm", 2},
                                                      {"-texres", 1}, {"-imfchan", 1}, {"-bm", 1}};
    rest = trimmed(rest);
    while (!rest.empty() && rest.front() == '-') {
        std::istringstream words(rest);
        std::string option, value;
        words >> option;
        const auto values = kValuesOf.find(option);
        if (values == kValuesOf.end())
            throw Error(place, "a picture over the texture coordinates as they are",
                        "\"" + option + "\"");
        for (int i = 0; i < values->second; ++i) words >> value;
        std::getline(words, rest);
        rest = trimmed(rest);
    }
    std::replace(rest.begin(), rest.end(), '\\', '/');
    return rest;
}

/// Adds the picture of each material of an MTL file.
void read_library(const std::filesystem::path& file,
                  std::map<std::string, geom::Texture>& textures) {
    std::ifstream in(file);
    std::string line, material;
    for (int number = 1; std::getline(in, line); ++number) {
        line = trimmed(line);
        const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
        const std::string key = line.substr(0, end), rest = trimmed(line.substr(end));
        if (key == "newmtl") material = rest;
        if (key != "map_Kd") continue;
        const std::string place = file.string() + ":" + std::to_string(number);
        const std::string name = picture_name(rest, place);
        if (name.empty()) throw Error(place, "the name of a picture after \"map_Kd\"", "none");
        textures[material] = {file.parent_path() / name, place, {}};
    }
}

}  // namespace

void add_obj_textures(const std::filesystem::path& obj, const ObjMaterials& materials,
                      geom::PolygonMesh& mesh) {
    std::map<std::string, geom::Texture> pictures;
    for (const std::string& library : materials.libraries)
        if (const auto file = obj.parent_path() / library; std::filesystem::is_regular_file(file))
            read_library(file, pictures);
    std::vector<int> texture_of_material;
    for (const std::string& name : materials.names) {
        const auto found = pictures.find(name);
        texture_of_material.push_back(-1);
        if (found == pictures.end()) continue;
        const auto known = std::find_if(
            mesh.textures.begin(), mesh.textures.end(),
            [&](const geom::Texture& texture) { return texture.file == found->second.file; });
        texture_of_material.back() = static_cast<int>(known - mesh.textures.begin());
        if (known == mesh.textures.end()) mesh.textures.push_back(found->second);
    }
    if (mesh.textures.empty()) return;
    for (const int material : materials.of_face)
        mesh.face_texture.push_back(
            material < 0 ? -1 : texture_of_material[static_cast<std::size_t>(material)]);
}

}  // namespace risorius::io::detail
