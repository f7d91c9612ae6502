// SPDX-License-Identifier: MIT
#include "tools/import_mesh/scene_reader.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "risorius/geom/part_sheets.h"
#include "tools/import_mesh/ply_strips.h"

namespace risorius::import_mesh {
namespace {

Rigid::MatrixType matrix4(const aiMatrix4x4& m) {
    Rigid::MatrixType out;
    for (unsigned r = 0; r < 4; ++r)
        for (unsigned c = 0; c < 4; ++c) out(r, c) = static_cast<double>(m[r][c]);
    return out;
}

/// For messages. Numbers of files have been floats.
std::string rounded(double number) {
    std::ostringstream out;
    out << number;
    return out.str();
}

/// The unit that the file states, in metres. FBX states centimetres per unit, and assimp does not apply it to positions.
double stated_metres_per_unit(const aiScene& scene, const std::string& name) {
    constexpr double kMetresPerCentimetre = 0.01;
    if (!scene.mMetaData) return 1.0;
    double centimetres = 0.0;
    if (!scene.mMetaData->Get("UnitScaleFactor", centimetres)) {
        float single = 0.0F;
        if (!scene.mMetaData->Get("UnitScaleFactor", single)) return 1.0;
        centimetres = static_cast<double>(single);
    }
    if (!(centimetres > 0) || !std::isfinite(centimetres))
        throw NoMesh({name, "a unit (UnitScaleFactor) above 0 cm", rounded(centimetres)});
    return centimetres * kMetresPerCentimetre;
}

/// Opens regular files to read, and nothing else.
class FilesToRead : public Assimp::DefaultIOSystem {
  public:
    bool Exists(const char* file) const override {
        std::error_code ignored;
        return std::filesystem::is_regular_file(file, ignored);
    }
    Assimp::IOStream* Open(const char* file, const char* mode) override {
        return *mode == 'r' && Exists(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
    }
};

bool has_polygons(const aiMesh& mesh) {
    return std::any_of(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                       [](const aiFace& face) { return face.mNumIndices >= 3; });
}

/// True when there is one vertex per face corner, in the order of corners: then the import has lost the file's indices.
bool is_unrolled(const aiMesh& mesh) {
    unsigned next = 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
        for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
            if (mesh.mFaces[f].mIndices[k] != next++) return false;
    return next == mesh.mNumVertices;
}

bool same_vertices(const aiMesh& a, const aiMesh& b) {
    return a.mNumVertices == b.mNumVertices &&
           std::memcmp(a.mVertices, b.mVertices, a.mNumVertices * sizeof(aiVector3D)) == 0;
}

class SceneReader {
  public:
    SceneReader(const aiScene& scene, const std::string& name, bool keep_vertices)
        : scene_(scene), name_(name), keep_vertices_(keep_vertices) {}

    geom::PolygonMesh read() {
        add_node(*scene_.mRootNode, Rigid::MatrixType::Identity());
        mesh_.positions.resize(static_cast<long>(positions_.size()), 3);
        for (std::size_t v = 0; v < positions_.size(); ++v)
            mesh_.positions.row(static_cast<long>(v)) = positions_[v].transpose();
        if (any_texcoord_) {
            mesh_.corner_texcoord.resize(static_cast<long>(texcoords_.size()), 2);
            for (std::size_t c = 0; c < texcoords_.size(); ++c)
                mesh_.corner_texcoord.row(static_cast<long>(c)) = texcoords_[c].transpose();
        }
        if (mesh_.textures.empty()) mesh_.face_texture.clear();
        return std::move(mesh_);
    }

  private:
    using Matrix4 = Rigid::MatrixType;
    using Key = std::array<float, 3>;

    void add_node(const aiNode& node, const Matrix4& parent) {
        const Matrix4 world = parent * matrix4(node.mTransformation);
        std::vector<const aiMesh*> meshes;
        for (unsigned m = 0; m < node.mNumMeshes; ++m) {
            const aiMesh* mesh = scene_.mMeshes[node.mMeshes[m]];
            if (has_polygons(*mesh)) meshes.push_back(mesh);
        }
        // A node whose faces assimp has sorted by material is one surface. Its corners are joined across those meshes.
        std::map<Key, int> vertex_at;
        std::vector<int> first_vertex(meshes.size());
        for (std::size_t m = 0; m < meshes.size(); ++m) {
            require_valid_indices(*meshes[m]);
            const int group = new_group(node, meshes, m);
            if (!keep_vertices_ && is_unrolled(*meshes[m])) {
                mesh_.in_file_order = false;
                add_faces(*meshes[m], world, group, join_corners(*meshes[m], world, vertex_at));
                continue;
            }
            // glTF primitives of one mesh may share a vertex buffer, which assimp copies for each of them.
            first_vertex[m] = static_cast<int>(positions_.size());
            for (std::size_t before = 0; before < m; ++before)
                if (same_vertices(*meshes[before], *meshes[m])) {
                    first_vertex[m] = first_vertex[before];
                    break;
                }
            if (first_vertex[m] == static_cast<int>(positions_.size()))
                for (unsigned v = 0; v < meshes[m]->mNumVertices; ++v)
                    positions_.push_back(transformed(world, meshes[m]->mVertices[v]));
            std::vector<int> vertices(meshes[m]->mNumVertices);
            for (std::size_t v = 0; v < vertices.size(); ++v)
                vertices[v] = first_vertex[m] + static_cast<int>(v);
            add_faces(*meshes[m], world, group, vertices);
        }
        for (unsigned c = 0; c < node.mNumChildren; ++c) add_node(*node.mChildren[c], world);
    }

    /// For some formats (PLY), assimp passes indices on without checking them.
    void require_valid_indices(const aiMesh& mesh) const {
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
                if (mesh.mFaces[f].mIndices[k] >= mesh.mNumVertices)
                    throw NoMesh({name_ + ":face " + std::to_string(f),
                                  "vertices in 0 .. " +
                                      std::to_string(static_cast<long>(mesh.mNumVertices) - 1),
                                  std::to_string(mesh.mFaces[f].mIndices[k])});
    }

    static Vec3 transformed(const Matrix4& world, const aiVector3D& p) {
        return world.topLeftCorner<3, 3>() * Vec3(p.x, p.y, p.z) + world.topRightCorner<3, 1>();
    }

    std::vector<int> join_corners(const aiMesh& mesh, const Matrix4& world,
                                  std::map<Key, int>& vertex_at) {
        std::vector<int> vertices(mesh.mNumVertices);
        for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
            const aiVector3D& p = mesh.mVertices[v];
            // A NaN cannot be ordered. Such a corner stays separate, and the caller reports it.
            const bool ordered = p.x == p.x && p.y == p.y && p.z == p.z;
            const int next = static_cast<int>(positions_.size());
            const int vertex =
                ordered ? vertex_at.try_emplace({p.x, p.y, p.z}, next).first->second : next;
            if (vertex == next) positions_.push_back(transformed(world, p));
            vertices[v] = vertex;
        }
        return vertices;
    }

    void add_faces(const aiMesh& mesh, const Matrix4& world, int group,
                   const std::vector<int>& vertices) {
        // A mirroring transform turns faces inside out. Their corners are listed backwards to undo it.
        const bool mirrored = world.topLeftCorner<3, 3>().determinant() < 0;
        const bool textured = mesh.HasTextureCoords(0);
        any_texcoord_ |= textured;
        const int texture = textured ? texture_of(mesh) : -1;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices < 3) continue;  // points and lines
            for (unsigned k = 0; k < face.mNumIndices; ++k) {
                const unsigned index = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
                mesh_.corner_vertex.push_back(vertices[index]);
                texcoords_.push_back(textured ? Vec2(mesh.mTextureCoords[0][index].x,
                                                     mesh.mTextureCoords[0][index].y)
                                              : Vec2(0, 0));
            }
            mesh_.face_begin.push_back(static_cast<int>(mesh_.corner_vertex.size()));
            mesh_.face_group.push_back(group);
            mesh_.face_texture.push_back(texture);
        }
    }

    /// Index of the colour picture of a material; -1 without one.
    int texture_of(const aiMesh& mesh) {
        const aiMaterial& material = *scene_.mMaterials[mesh.mMaterialIndex];
        aiString path;
        if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &path) != aiReturn_SUCCESS &&
            material.GetTexture(aiTextureType_DIFFUSE, 0, &path) != aiReturn_SUCCESS)
            return -1;
        const auto [entry, is_new] =
            texture_at_.try_emplace(path.C_Str(), static_cast<int>(mesh_.textures.size()));
        if (!is_new) return entry->second;
        std::string relative = path.C_Str();
        std::replace(relative.begin(), relative.end(), '\\', '/');
        geom::Texture texture{std::filesystem::path(name_).parent_path() / relative,
                              name_ + ":material \"" + material.GetName().C_Str() + "\"",
                              {}};
        // Height 0: the bytes of a picture's file.
        if (const aiTexture* inside = scene_.GetEmbeddedTexture(path.C_Str());
            inside && inside->mHeight == 0) {
            const auto* bytes = reinterpret_cast<const std::uint8_t*>(inside->pcData);
            texture.embedded.assign(bytes, bytes + inside->mWidth);
        }
        mesh_.textures.push_back(std::move(texture));
        return entry->second;
    }

    int new_group(const aiNode& node, const std::vector<const aiMesh*>& meshes, std::size_t m) {
        // assimp writes a name in angle brackets when the file gives none.
        const auto given = [](const aiString& name) {
            const std::string text = name.C_Str();
            return text.empty() || text.front() == '<' ? std::string() : text;
        };
        std::string name = given(node.mName);
        if (name.empty()) name = given(meshes[m]->mName);
        if (name.empty()) name = "default";
        if (meshes.size() > 1) {
            const std::string material =
                given(scene_.mMaterials[meshes[m]->mMaterialIndex]->GetName());
            name += "." + (material.empty() ? std::to_string(m) : material);
        }
        // Two nodes with the same name stay two groups.
        std::string unique = name;
        for (int n = 2; !names_.insert(unique).second; ++n) unique = name + "." + std::to_string(n);
        mesh_.group_names.push_back(unique);
        return static_cast<int>(mesh_.group_names.size()) - 1;
    }

    const aiScene& scene_;
    std::string name_;
    bool keep_vertices_;
    geom::PolygonMesh mesh_;
    std::vector<Vec3> positions_;
    std::vector<Vec2> texcoords_;
    bool any_texcoord_ = false;
    std::set<std::string> names_;
    std::map<std::string, int> texture_at_;
};

}  // namespace

geom::PolygonMesh read_scene(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".ply" && has_strips(file)) return read_ply_with_strips(file);
    Assimp::Importer importer;
    importer.SetIOHandler(new FilesToRead);  // which the importer owns
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    const aiScene* scene = importer.ReadFile(file.string(), 0);
    if (!scene || !scene->mRootNode)
        throw NoMesh({file.string(), "a mesh that assimp can read", importer.GetErrorString()});
    geom::PolygonMesh mesh = SceneReader(*scene, file.string(), ending == ".ply").read();
    if (mesh.face_count() == 0) throw NoMesh({file.string(), "faces", "none"});
    // assimp multiplies the first node by the unit of COLLADA.
    const double volume =
        matrix4(scene->mRootNode->mTransformation).topLeftCorner<3, 3>().determinant();
    if (ending == ".dae" && !(volume > 0))
        throw NoMesh({file.string(), "a unit (meter) above 0", rounded(std::cbrt(volume))});
    const double unit_m = stated_metres_per_unit(*scene, file.string());
    mesh.positions *= unit_m;
    if (!mesh.in_file_order) geom::part_sheets(mesh);
    // These state a unit and an axis, which assimp puts into the first node.
    if (ending == ".fbx" || ending == ".dae") {
        mesh.from_file = matrix4(scene->mRootNode->mTransformation);
        mesh.from_file.topRows<3>() *= unit_m;
    }
    // A file of triangles alone has no list of vertices whose order could be lost.
    if (ending == ".stl") mesh.in_file_order = true;
    return mesh;
}

}  // namespace risorius::import_mesh
