// SPDX-License-Identifier: MIT
#include "risorius/scene/scene_from_rig.h"

#include <functional>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/scene/texture_picture.h"

namespace risorius::scene {

namespace {

using render::Material;

std::optional<Material> material_of(const std::string& role) {
    if (role == "skin") return Material::kSkin;
    if (role == "mouth" || role == "eye_socket") return Material::kMouth;  // moist, red
    if (role.starts_with("eye_")) return Material::kEye;
    if (role.starts_with("cornea")) return Material::kCornea;
    if (role.starts_with("teeth")) return Material::kTeeth;
    if (role.starts_with("gums")) return Material::kGums;
    if (role == "tongue") return Material::kTongue;
    if (role.starts_with("lashes")) return Material::kLashes;
    return std::nullopt;
}

/// One value per triangle of a group, in the order of geom::triangulate().
std::vector<int> textures_of(const geom::PolygonMesh& mesh, int group) {
    std::vector<int> textures;
    for (int face = 0; face < mesh.face_count(); ++face) {
        const auto f = static_cast<std::size_t>(face);
        if (mesh.face_group[f] != group) continue;
        const int texture = mesh.face_texture.empty() ? -1 : mesh.face_texture[f];
        textures.insert(textures.end(), static_cast<std::size_t>(mesh.corner_count(face) - 2),
                        texture);
    }
    return textures;
}

// The triangles of a group and texture that `wanted` accepts, with their texture coordinates. Seams of the skin are closed: each
// vertex is replaced by its representative, so that normals are continuous.
render::Surface surface_of(const rig::Head& head, const geom::PolygonMesh& mesh, int group,
                           Material material, int texture,
                           const std::function<bool(int vertex)>& wanted) {
    Triangles corners;
    const Triangles all = geom::triangulate(mesh, {group}, &corners);
    const std::vector<int> texture_of = textures_of(mesh, group);
    std::vector<long> kept;
    Triangles welded = all;
    for (long f = 0; f < all.rows(); ++f) {
        for (int k = 0; k < 3; ++k) welded(f, k) = head.welded[static_cast<std::size_t>(all(f, k))];
        const bool collapsed = welded(f, 0) == welded(f, 1) || welded(f, 1) == welded(f, 2) ||
                               welded(f, 2) == welded(f, 0);
        if (!collapsed && texture_of[static_cast<std::size_t>(f)] == texture && wanted(all(f, 0)))
            kept.push_back(f);
    }
    render::Surface surface;
    surface.material = material;
    surface.texture = texture;
    const long count = static_cast<long>(kept.size());
    surface.triangles.resize(count, 3);
    if (mesh.corner_texcoord.rows() > 0) surface.texcoords.resize(3 * count, 2);
    for (long i = 0; i < count; ++i) {
        const long f = kept[static_cast<std::size_t>(i)];
        surface.triangles.row(i) = welded.row(f);
        if (surface.texcoords.rows() > 0)
            for (int k = 0; k < 3; ++k)
                surface.texcoords.row(3 * i + k) = mesh.corner_texcoord.row(corners(f, k));
    }
    return surface;
}

// The positions of the vertices with closed lids.
Points eyes_shut(const rig::Head& head, const rig::RigDescription& rig) {
    Points shut = head.vertices;
    const face::LidPose closed{.upper_closure = 1, .lower_closure = 1, .inward = 0.5};
    for (int side = 0; side < 2; ++side) {
        const face::EyeLids lids(head, side, rig.eyes.lid_closed_fraction);
        for (Eigen::Index v = 0; v < shut.rows(); ++v) {
            const Vec3 p = head.vertices.row(v).transpose();
            if (head.carrier[static_cast<std::size_t>(v)] == rig::Carrier::kSkin &&
                (p - lids.centre()).norm() < lids.zone_m() + head.mm(4) &&
                p.z() > lids.centre().z())
                shut.row(v) += lids.ride(p, lids.member(p), closed).transpose();
        }
    }
    return shut;
}

// Reads a texture when it is first needed.
class TexturePictures {
  public:
    TexturePictures(const geom::PolygonMesh& mesh, bool wanted, std::vector<Image>& images)
        : mesh_(mesh), images_(images), index_(mesh.textures.size(), wanted ? kUnread : -1) {}

    int index_of(int texture) {
        const auto t = static_cast<std::size_t>(texture);
        if (index_[t] != kUnread) return index_[t];
        try {
            images_.push_back(read_texture(mesh_.textures[t]));
        } catch (const Error&) {
            // picture_problems() says so; the surface has the colours of the look.
            return index_[t] = -1;
        }
        return index_[t] = static_cast<int>(images_.size()) - 1;
    }

  private:
    static constexpr int kUnread = -2;
    const geom::PolygonMesh& mesh_;
    std::vector<Image>& images_;
    std::vector<int> index_;
};

}  // namespace

std::vector<std::string> picture_problems(const geom::PolygonMesh& mesh) {
    constexpr std::size_t kMost = 20;
    std::vector<std::string> out;
    for (const geom::Texture& texture : mesh.textures) {
        if (out.size() == kMost) break;
        try {
            read_texture(texture);
        } catch (const Error& error) {
            out.push_back(std::string(error.what()) +
                          "; what it would colour has the colours of the look");
        }
    }
    return out;
}

render::Scene scene_from_rig(const rig::Head& head, const rig::RigDescription& rig,
                             const geom::PolygonMesh& mesh) {
    render::Scene scene;
    scene.rest = head.vertices;
    scene.shut = eyes_shut(head, rig);
    scene.landmarks = head.landmarks;
    TexturePictures pictures(mesh, rig.appearance.textures == "mesh", scene.textures);

    // One surface per group of faces and texture. The tongue is separated from the gums by connected components.
    const auto add = [&](int group, Material material, const std::function<bool(int)>& wanted) {
        const std::string& role = head.role_of_group[static_cast<std::size_t>(group)];
        const bool clear = material == Material::kCornea || material == Material::kLashes;
        for (int texture = -1; texture < static_cast<int>(mesh.textures.size()); ++texture) {
            render::Surface surface = surface_of(head, mesh, group, material, texture, wanted);
            if (material == Material::kEye || material == Material::kCornea)
                surface.eye = role.ends_with("_l") ? 0 : 1;
            if (surface.triangles.rows() == 0) continue;
            surface.texture = texture < 0 || clear ? -1 : pictures.index_of(texture);
            scene.surfaces.push_back(std::move(surface));
        }
    };
    const auto is_tongue = [&](int vertex) {
        return head.carrier[static_cast<std::size_t>(vertex)] == rig::Carrier::kTongue;
    };
    for (std::size_t g = 0; g < head.role_of_group.size(); ++g) {
        const int group = static_cast<int>(g);
        const std::string& role = head.role_of_group[g];
        if (role == "gums_tongue") {
            add(group, Material::kTongue, is_tongue);
            add(group, Material::kGums, [&](int vertex) { return !is_tongue(vertex); });
        } else if (const auto material = material_of(role)) {
            add(group, *material, [](int) { return true; });
        }
    }

    for (int side = 0; side < 2; ++side) {
        const rig::EyeGeometry& eye = head.eyes[static_cast<std::size_t>(side)];
        render::Eye& out = scene.eyes[static_cast<std::size_t>(side)];
        out.centre = eye.centre;
        out.radius_m = eye.radius_m;
        out.iris_radius_m = head.mm(rig.eyes.iris_radius_mm);
        out.pupil_radius_m = head.mm(rig.eyes.pupil_radius_mm);
        out.forward = eye.forward;
    }
    scene.appearance = {.skin_tone = rig.appearance.skin_tone,
                        .lip_tone = rig.appearance.lip_tone,
                        .hair_tone = rig.appearance.hair_tone,
                        .iris_tone = rig.appearance.iris_tone,
                        .freckles = rig.appearance.freckles,
                        .scalp_hair = rig.appearance.scalp_hair,
                        .hairline_mm = rig.appearance.hairline_mm,
                        .temples_mm = rig.appearance.temples_mm,
                        .hair_length_mm = rig.appearance.hair_length_mm,
                        .beard_length_mm = rig.appearance.beard_length_mm,
                        .beard = rig.appearance.beard,
                        .age = rig.appearance.age,
                        .seed = static_cast<unsigned>(rig.appearance.seed),
                        .hair_style = rig.appearance.hair_style,
                        .lock_length = rig.appearance.lock_length,
                        .lock_wave = rig.appearance.lock_wave,
                        .fringe = rig.appearance.fringe,
                        .parting = rig.appearance.parting,
                        .hairline_form = rig.appearance.hairline_form,
                        .age_lines = rig.appearance.age_lines,
                        .grey_hair = rig.appearance.grey_hair,
                        .beard_form = rig.appearance.beard_form,
                        .brow_density = rig.appearance.brow_density,
                        .brow_width = rig.appearance.brow_width,
                        .skin_gloss = rig.appearance.skin_gloss,
                        .complexion = rig.appearance.complexion,
                        .mottling = rig.appearance.mottling,
                        .garment = rig.appearance.garment,
                        .garment_tone = rig.appearance.garment_tone};
    return scene;
}

void add_wrinkles(const face::WrinkleLines& lines, render::Scene& scene) {
    scene.fold_phase = lines.phase;
}

render::Pose pose_for_view(const face::FacePose& pose) {
    render::Pose out;
    out.positions = pose.vertices;
    out.eye_rotation = pose.eye_rotation;
    out.jaw_open = pose.jaw_open;
    out.fold_depth = pose.fold_depth;
    return out;
}

render::Muscles muscles_for_view(const face::MuscleSurfaces& surfaces) {
    render::Muscles muscles;
    muscles.rest = surfaces.rest;
    muscles.fibre = surfaces.fibre;
    muscles.tendon = surfaces.tendon;
    for (const face::MuscleSurface& surface : surfaces.muscles) {
        const int side = surface.side ? static_cast<int>(*surface.side) : -1;
        muscles.parts.push_back({surface.muscle, side, surface.triangles});
    }
    return muscles;
}

void add_muscles(const face::MuscleSurfaces& surfaces, const Eigen::VectorXd& activation,
                 Points vertices, render::Pose& pose) {
    pose.muscle_positions = std::move(vertices);
    for (const face::MuscleSurface& surface : surfaces.muscles)
        pose.activations.push_back(surface.column < 0 ? 0.0 : activation[surface.column]);
}

render::Bones bones_for_view(const face::Skull& skull) {
    const face::BoneSurface &upper = skull.cranium, &lower = skull.mandible;
    render::Bones bones;
    bones.rest.resize(upper.vertices.rows() + lower.vertices.rows(), 3);
    bones.rest << upper.vertices, lower.vertices;
    bones.triangles.resize(upper.triangles.rows() + lower.triangles.rows(), 3);
    bones.triangles << upper.triangles,
        (lower.triangles.array() + static_cast<int>(upper.vertices.rows())).matrix();
    bones.open = upper.open;
    bones.open.insert(bones.open.end(), lower.open.begin(), lower.open.end());
    return bones;
}

void add_bones(const face::Skull& skull, const face::FacePose& pose, render::Pose& out) {
    const face::BoneSurface &upper = skull.cranium, &lower = skull.mandible;
    const auto placed = [](const Rigid& where, const Points& rest) -> Points {
        return (rest * where.linear().transpose()).rowwise() + where.translation().transpose();
    };
    out.bone_positions.resize(upper.vertices.rows() + lower.vertices.rows(), 3);
    out.bone_positions << placed(pose.head, upper.vertices),
        placed(pose.head * pose.mandible, lower.vertices);
}

}  // namespace risorius::scene
