// SPDX-License-Identifier: MIT
#include "risorius/view/scene_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/render/value_colour.h"

namespace risorius::view {

namespace {

constexpr std::uint32_t kSceneKind = 2, kPictureKind = 3, kMusclesKind = 4, kMeshKind = 5,
                        kSkullKind = 6, kFileKind = 7;

const char* name_of(render::Material material) {
    switch (material) {
        case render::Material::kSkin:
            return "skin";
        case render::Material::kEye:
            return "eye";
        case render::Material::kCornea:
            return "cornea";
        case render::Material::kTeeth:
            return "teeth";
        case render::Material::kGums:
            return "gums";
        case render::Material::kTongue:
            return "tongue";
        case render::Material::kMouth:
            return "mouth";
        case render::Material::kLashes:
            return "lashes";
        case render::Material::kMatte:
            return "matte";
    }
    return "matte";
}

/// Arrays behind one another, each at a multiple of 4 bytes.
class Arrays {
  public:
    /// Returns {"at": ..., "count": ...}.
    template <class T>
    Json add(const std::vector<T>& values) {
        Json place = json_object({{"at", bytes_.size()}, {"count", values.size()}});
        bytes_.append(reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size());
        bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
        return place;
    }
    Json add(const Points& points) {
        std::vector<float> values;
        for (long i = 0; i < points.rows(); ++i)
            for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(points(i, k)));
        return add(values);
    }
    std::string message(std::uint32_t kind, const Json& head) const {
        std::string text = json_text(head);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::uint32_t numbers[2] = {kind, static_cast<std::uint32_t>(text.size())};
        return std::string(reinterpret_cast<const char*>(numbers), sizeof numbers) + text + bytes_;
    }

  private:
    std::string bytes_;
};

/// Triangles over corners: a vertex with two places on the texture has two corners.
struct Corners {
    std::vector<std::uint32_t> vertex, triangles;
    std::vector<float> texcoords;
};

Corners corners_of(const render::Surface& surface, const std::vector<int>& row) {
    Corners out;
    std::map<std::tuple<int, float, float>, std::uint32_t> known;
    const bool textured = surface.texcoords.rows() > 0;
    for (long f = 0; f < surface.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int vertex = surface.triangles(f, k);
            const auto u = textured ? static_cast<float>(surface.texcoords(3 * f + k, 0)) : 0.0f;
            const auto v = textured ? static_cast<float>(surface.texcoords(3 * f + k, 1)) : 0.0f;
            const auto [entry, added] =
                known.try_emplace({vertex, u, v}, static_cast<std::uint32_t>(out.vertex.size()));
            if (added) {
                out.vertex.push_back(
                    static_cast<std::uint32_t>(row[static_cast<std::size_t>(vertex)]));
                if (textured) out.texcoords.insert(out.texcoords.end(), {u, v});
            }
            out.triangles.push_back(entry->second);
        }
    return out;
}

Json colour_json(const Vec3& srgb) { return {srgb.x(), srgb.y(), srgb.z()}; }

/// The colours of 256 strains from -kStrainScale to kStrainScale, sRGB.
Json strain_colours() {
    constexpr int kCount = 256;
    Json out = Json::array();
    for (int i = 0; i < kCount; ++i)
        out.push_back(
            colour_json(render::srgb_of(render::value_colour(-1 + 2.0 * i / (kCount - 1), -1, 1))));
    return out;
}

}  // namespace

Points DrawnVertices::of(const Points& all) const {
    Points out(static_cast<long>(vertex.size()), 3);
    for (long i = 0; i < out.rows(); ++i) out.row(i) = all.row(vertex[static_cast<std::size_t>(i)]);
    return out;
}

DrawnVertices drawn_vertices(const render::Scene& scene) {
    std::vector<char> used(static_cast<std::size_t>(scene.rest.rows()), 0);
    for (const render::Surface& surface : scene.surfaces)
        for (long f = 0; f < surface.triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k) used[static_cast<std::size_t>(surface.triangles(f, k))] = 1;
    DrawnVertices drawn;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) drawn.vertex.push_back(static_cast<int>(v));
    return drawn;
}

std::string encode_scene(const render::Scene& scene, const DrawnVertices& drawn,
                         const std::vector<char>& soft, double unit_m) {
    Arrays arrays;
    std::vector<int> row(static_cast<std::size_t>(scene.rest.rows()), -1);
    std::vector<std::uint8_t> pullable;
    for (std::size_t i = 0; i < drawn.vertex.size(); ++i) {
        const auto vertex = static_cast<std::size_t>(drawn.vertex[i]);
        row[vertex] = static_cast<int>(i);
        pullable.push_back(static_cast<std::uint8_t>(soft[vertex]));
    }
    Json surfaces = Json::array();
    for (const render::Surface& surface : scene.surfaces) {
        if (surface.triangles.rows() == 0) continue;
        const Corners corners = corners_of(surface, row);
        surfaces.push_back(json_object({{"material", name_of(surface.material)},
                                        {"eye", surface.eye},
                                        {"texture", surface.texture},
                                        {"vertex", arrays.add(corners.vertex)},
                                        {"triangles", arrays.add(corners.triangles)},
                                        {"texcoords", arrays.add(corners.texcoords)}}));
    }
    Json landmarks = Json::object();
    for (const auto& [id, p] : scene.landmarks) landmarks[id] = {p.x(), p.y(), p.z()};
    Json eyes = Json::array();
    for (const render::Eye& eye : scene.eyes)
        eyes.push_back(
            json_object({{"centre", {eye.centre.x(), eye.centre.y(), eye.centre.z()}},
                         {"radius_m", eye.radius_m},
                         {"iris_radius_m", eye.iris_radius_m},
                         {"pupil_radius_m", eye.pupil_radius_m},
                         {"forward", {eye.forward.x(), eye.forward.y(), eye.forward.z()}}}));
    const render::Appearance& looks = scene.appearance;
    const Json head = json_object({{"unit_m", unit_m},
                                   {"vertices", drawn.vertex.size()},
                                   {"vertex", arrays.add(std::vector<std::int32_t>(
                                                  drawn.vertex.begin(), drawn.vertex.end()))},
                                   {"rest", arrays.add(drawn.of(scene.rest))},
                                   {"soft", arrays.add(pullable)},
                                   {"surfaces", surfaces},
                                   {"landmarks", landmarks},
                                   {"eyes", eyes},
                                   {"skin_tone", colour_json(looks.skin_tone)},
                                   {"lip_tone", colour_json(looks.lip_tone)},
                                   {"hair_tone", colour_json(looks.hair_tone)},
                                   {"iris_tone", colour_json(looks.iris_tone)},
                                   {"strain_scale", 0.4},
                                   {"strain_colours", strain_colours()}});
    return arrays.message(kSceneKind, head);
}

std::string encode_picture(const std::string& material, const Image& picture) {
    Arrays arrays;
    const Json head = json_object({{"material", material},
                                   {"width_px", picture.width_px},
                                   {"height_px", picture.height_px},
                                   {"rgba", arrays.add(std::vector<std::uint8_t>(
                                                picture.rgba.begin(), picture.rgba.end()))}});
    return arrays.message(kPictureKind, head);
}

std::string encode_muscles(const face::MuscleSurfaces& surfaces) {
    Arrays arrays;
    Json parts = Json::array();
    for (const face::MuscleSurface& muscle : surfaces.muscles) {
        std::vector<std::uint32_t> triangles;
        for (long f = 0; f < muscle.triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k)
                triangles.push_back(static_cast<std::uint32_t>(muscle.triangles(f, k)));
        parts.push_back(json_object({{"muscle", muscle.muscle},
                                     {"side", !muscle.side                  ? ""
                                              : *muscle.side == Side::kLeft ? "l"
                                                                            : "r"},
                                     {"column", muscle.column},
                                     {"triangles", arrays.add(triangles)}}));
    }
    std::vector<float> tendon(surfaces.tendon.begin(), surfaces.tendon.end());
    const Json head = json_object(
        {{"parts", parts}, {"rest", arrays.add(surfaces.rest)}, {"tendon", arrays.add(tendon)}});
    return arrays.message(kMusclesKind, head);
}

std::string encode_skull(const face::Skull& skull) {
    Arrays arrays;
    const auto bone = [&](const face::BoneSurface& surface) {
        std::vector<std::uint32_t> triangles;
        for (long f = 0; f < surface.triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k)
                triangles.push_back(static_cast<std::uint32_t>(surface.triangles(f, k)));
        const Json vertices = arrays.add(surface.vertices);
        return json_object({{"vertices", vertices}, {"triangles", arrays.add(triangles)}});
    };
    Json head = json_object({{"cranium", bone(skull.cranium)}});
    head["mandible"] = bone(skull.mandible);
    return arrays.message(kSkullKind, head);
}

std::string encode_mesh(const geom::PolygonMesh& mesh, const MeshLabels& labels) {
    Arrays arrays;
    Json groups = Json::array();
    std::vector<std::uint32_t> triangles;
    for (std::size_t g = 0; g < mesh.group_names.size(); ++g) {
        const std::size_t from = triangles.size() / 3;
        const Triangles of_group = geom::triangulate(mesh, {static_cast<int>(g)});
        for (long f = 0; f < of_group.rows(); ++f)
            for (int k = 0; k < 3; ++k)
                triangles.push_back(static_cast<std::uint32_t>(of_group(f, k)));
        groups.push_back(json_object(
            {{"name", mesh.group_names[g]},
             {"from", from},
             {"count", triangles.size() / 3 - from},
             {"role", g < labels.role_of_group.size() ? labels.role_of_group[g] : std::string()}}));
    }
    const Json head = json_object({{"file", labels.file},
                                   {"rig", labels.rig},
                                   {"roles", labels.roles},
                                   {"vertices", arrays.add(mesh.positions)},
                                   {"triangles", arrays.add(triangles)},
                                   {"groups", groups}});
    return arrays.message(kMeshKind, head);
}

std::string encode_file(const std::string& name, const std::string& type,
                        const std::string& bytes) {
    Arrays arrays;
    const Json head =
        json_object({{"name", name},
                     {"type", type},
                     {"bytes", arrays.add(std::vector<std::uint8_t>(bytes.begin(), bytes.end()))}});
    return arrays.message(kFileKind, head);
}

}  // namespace risorius::view
