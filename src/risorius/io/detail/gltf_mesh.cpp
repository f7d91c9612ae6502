// SPDX-License-Identifier: MIT
#include "risorius/io/detail/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "risorius/core/error.h"
#include "risorius/io/detail/gltf_file.h"
#include "risorius/io/detail/mesh_limits.h"
#include "risorius/io/detail/picture_place.h"

namespace risorius::io::detail {

namespace {

/// `width` numbers of a list in the JSON.
std::vector<double> numbers_of(const JsonCursor& list, std::size_t width) {
    std::vector<double> out;
    for (const JsonCursor& item : list.items()) out.push_back(item.number());
    if (out.size() != width)
        list.fail(std::to_string(width) + " numbers", std::to_string(out.size()));
    return out;
}

}  // namespace

Eigen::Matrix4d transform_of(const JsonCursor& node) {
    if (const auto matrix = node.find("matrix"))
        return Eigen::Map<const Eigen::Matrix4d>(numbers_of(*matrix, 16).data());
    Eigen::Affine3d out = Eigen::Affine3d::Identity();
    if (const auto list = node.find("translation")) {
        const auto t = numbers_of(*list, 3);
        out.translate(Vec3(t[0], t[1], t[2]));
    }
    if (const auto list = node.find("rotation")) {
        const auto q = numbers_of(*list, 4);
        const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
        if (turn.norm() > 0) out.rotate(turn.normalized());
    }
    if (const auto list = node.find("scale")) {
        const auto s = numbers_of(*list, 3);
        out.scale(Vec3(s[0], s[1], s[2]));
    }
    return out.matrix();
}

namespace {

using Matrix4 = Eigen::Matrix4d;
using Index = std::uint32_t;

constexpr int kTriangles = 4, kStrip = 5, kFan = 6;  // modes of primitives

std::string name_of(const JsonCursor& item) {
    const auto name = item.find("name");
    return name ? name->string() : std::string();
}

/// Triangles of a primitive as corners, in the order of the file.
std::vector<Index> corners_of(const std::vector<Index>& listed, int mode) {
    std::vector<Index> out;
    if (mode == kTriangles) {
        out = listed;
        out.resize(listed.size() / 3 * 3);
        return out;
    }
    for (std::size_t i = 0; i + 2 < listed.size(); ++i) {
        // Every second triangle of a strip runs the other way round.
        const std::size_t a = mode == kFan ? 0 : i + i % 2,
                          b = mode == kFan ? i + 1 : i + 1 - i % 2;
        out.insert(out.end(), {listed[a], listed[b], listed[i + 2]});
    }
    return out;
}

class MeshOfGltf {
  public:
    explicit MeshOfGltf(const std::filesystem::path& file)
        : file_(file), gltf_(file, "a glTF file") {}

    geom::PolygonMesh read() {
        place_nodes();
        for (const std::size_t node : order_) {
            const JsonCursor& here = gltf_.list("nodes")[node];
            if (const auto mesh = here.find("mesh"))
                add_mesh(here, node, gltf_.item("meshes", *mesh));
        }
        if (mesh_.face_count() == 0) throw Error(file_.string(), "faces", "none");
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
    struct Primitive {
        JsonCursor json;
        std::vector<Index> corners;
        std::string material;  ///< its name, or empty
    };

    /// Places every node, and finds the order of those in the scene: parents first, as listed.
    void place_nodes() {
        const auto& nodes = gltf_.list("nodes");
        std::vector<std::vector<std::size_t>> children(nodes.size());
        std::vector<bool> is_child(nodes.size(), false);
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            const auto list = nodes[n].find("children");
            if (!list) continue;
            for (const JsonCursor& reference : list->items()) {
                const auto child =
                    static_cast<std::size_t>(&gltf_.item("nodes", reference) - nodes.data());
                if (is_child[child]) reference.fail("a node with one parent", "one with two");
                is_child[child] = true;
                children[n].push_back(child);
            }
        }
        world_.assign(nodes.size(), Matrix4::Identity());
        std::vector<bool> reached(nodes.size(), false);
        const auto walk = [&](std::size_t root, bool listed) {
            std::vector<std::size_t> open{root};
            while (!open.empty()) {
                const std::size_t n = open.back();
                open.pop_back();
                if (listed && !wanted_.insert(n).second) continue;
                if (listed) order_.push_back(n);
                if (!reached[n]) world_[n] *= transform_of(nodes[n]);
                reached[n] = true;
                for (std::size_t c = children[n].size(); c-- > 0;) {
                    const std::size_t child = children[n][c];
                    if (!reached[child]) world_[child] = world_[n];
                    open.push_back(child);
                }
            }
        };
        for (std::size_t n = 0; n < nodes.size(); ++n)
            if (!is_child[n]) walk(n, false);
        for (std::size_t n = 0; n < nodes.size(); ++n)
            if (!reached[n]) nodes[n].fail("a node that is not inside of itself", "one that is");
        const auto& scenes = gltf_.list("scenes");
        if (scenes.empty()) {
            for (std::size_t n = 0; n < nodes.size(); ++n)
                if (!is_child[n]) walk(n, true);
            return;
        }
        const auto shown = gltf_.json().find("scene");
        const JsonCursor& scene = shown ? gltf_.item("scenes", *shown) : scenes[0];
        if (const auto roots = scene.find("nodes"))
            for (const JsonCursor& root : roots->items()) {
                const auto n = static_cast<std::size_t>(&gltf_.item("nodes", root) - nodes.data());
                if (is_child[n]) root.fail("a node without a parent", "one with a parent");
                walk(n, true);
            }
    }

    void add_mesh(const JsonCursor& node, std::size_t node_index, const JsonCursor& mesh) {
        std::vector<Primitive> primitives;
        const std::vector<JsonCursor> listed = mesh.at("primitives").items();
        gltf_.spend(mesh, listed.size());
        for (const JsonCursor& primitive : listed)
            if (auto read = read_primitive(primitive)) primitives.push_back(std::move(*read));
        // Primitives of one mesh may share their vertices.
        std::vector<std::pair<Rows, int>> shared;
        std::map<std::string, std::size_t> shared_at;
        const Matrix4& world = world_[node_index];
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const Primitive& primitive = primitives[p];
            const JsonCursor attributes = primitive.json.at("attributes");
            const JsonCursor& accessor = gltf_.item("accessors", attributes.at("POSITION"));
            const auto [entry, is_new] = shared_at.try_emplace(accessor.place(), shared.size());
            if (is_new) {
                Rows positions = gltf_.rows(accessor, 3);
                const auto same =
                    std::find_if(shared.begin(), shared.end(), [&](const auto& other) {
                        return other.first.rows() == positions.rows() && other.first == positions;
                    });
                if (same != shared.end()) {
                    entry->second = static_cast<std::size_t>(same - shared.begin());
                } else {
                    const int first = static_cast<int>(positions_.size());
                    add_vertices(node, world, attributes, positions);
                    if (shared.size() < kMostCompared)
                        shared.emplace_back(std::move(positions), first);
                    else
                        shared.emplace_back(Rows(), first);
                }
            }
            const int first = shared[entry->second].second,
                      count = static_cast<int>(positions_.size()) - first;
            const std::string group = group_name(node, node_index, primitives, p);
            add_faces(primitive, first, count, new_group(group),
                      !node.has("skin") && world.topLeftCorner<3, 3>().determinant() < 0);
        }
    }

    std::optional<Primitive> read_primitive(const JsonCursor& primitive) {
        if (const auto extensions = primitive.find("extensions"))
            if (extensions->has("KHR_draco_mesh_compression"))
                extensions->at("KHR_draco_mesh_compression")
                    .fail("a mesh that is not packed by Draco (export it without compression)",
                          "one that is");
        const auto mode = primitive.find("mode");
        const int kind = mode ? mode->integer(0, kFan) : kTriangles;
        if (kind < kTriangles) return std::nullopt;  // points and lines
        const JsonCursor attributes = primitive.at("attributes");
        if (!attributes.has("POSITION")) return std::nullopt;
        const std::size_t vertices =
            gltf_.count(gltf_.item("accessors", attributes.at("POSITION")));
        std::vector<Index> listed;
        if (const auto indices = primitive.find("indices")) {
            listed = gltf_.indices(gltf_.item("accessors", *indices));
        } else {
            if (vertices > kMostVertices) attributes.fail(kFewerVertices, "more");
            // The positions are counted when they are read, below.
            gltf_.rows(gltf_.item("accessors", attributes.at("POSITION")), 3);
            for (std::size_t v = 0; v < vertices; ++v) listed.push_back(static_cast<Index>(v));
        }
        for (const Index index : listed)
            if (index >= vertices)
                primitive.fail("indices of its " + std::to_string(vertices) + " vertices",
                               std::to_string(index));
        std::vector<Index> corners = corners_of(listed, kind);
        if (corners.empty()) return std::nullopt;
        std::string material;
        if (const auto reference = primitive.find("material"))
            material = name_of(gltf_.item("materials", *reference));
        return Primitive{primitive, std::move(corners), std::move(material)};
    }

    /// A node with a skin lies where its joints are, and its own transform says nothing.
    void add_vertices(const JsonCursor& node, const Matrix4& world, const JsonCursor& attributes,
                      const Rows& positions) {
        if (positions_.size() + static_cast<std::size_t>(positions.rows()) > kMostVertices)
            attributes.fail(kFewerVertices, "more");
        const auto skin = node.find("skin");
        const bool bent = skin && attributes.has("JOINTS_0") && attributes.has("WEIGHTS_0");
        if (!bent) {
            const Matrix4 m = skin ? Matrix4::Identity() : world;
            for (long v = 0; v < positions.rows(); ++v)
                positions_.push_back(m.topLeftCorner<3, 3>() * positions.row(v).transpose() +
                                     m.topRightCorner<3, 1>());
            return;
        }
        const std::vector<Matrix4>& joints = joints_of(gltf_.item("skins", *skin));
        const JsonCursor& joint_accessor = gltf_.item("accessors", attributes.at("JOINTS_0"));
        const Rows joint = gltf_.rows(joint_accessor, 4),
                   weight = gltf_.rows(gltf_.item("accessors", attributes.at("WEIGHTS_0")), 4);
        if (joint.rows() != positions.rows() || weight.rows() != positions.rows())
            attributes.fail("joints and weights for each of its vertices", "others");
        for (long v = 0; v < positions.rows(); ++v) {
            const Vec3 p = positions.row(v).transpose();
            Vec3 sum = Vec3::Zero();
            double total = 0;
            for (int k = 0; k < 4; ++k) {
                if (!(weight(v, k) > 0)) continue;
                if (!(joint(v, k) < static_cast<double>(joints.size())))
                    joint_accessor.fail("one of the " + std::to_string(joints.size()) + " joints",
                                        format_number(joint(v, k)));
                const Matrix4& m = joints[static_cast<std::size_t>(joint(v, k))];
                sum += weight(v, k) * (m.topLeftCorner<3, 3>() * p + m.topRightCorner<3, 1>());
                total += weight(v, k);
            }
            positions_.push_back(total > 0 ? Vec3(sum / total) : p);
        }
    }

    /// What each joint of a skin does to the vertices that hang on it. Exactly nothing, where it is nothing but for rounding.
    const std::vector<Matrix4>& joints_of(const JsonCursor& skin) {
        const auto [entry, is_new] = joints_.try_emplace(skin.place());
        if (!is_new) return entry->second;
        const std::vector<JsonCursor> joints = skin.at("joints").items();
        Rows inverse;
        if (const auto reference = skin.find("inverseBindMatrices")) {
            const JsonCursor& accessor = gltf_.item("accessors", *reference);
            inverse = gltf_.rows(accessor, 16);
            if (inverse.rows() < static_cast<long>(joints.size()))
                accessor.fail(
                    "a matrix for each of the " + std::to_string(joints.size()) + " joints",
                    std::to_string(inverse.rows()));
        }
        constexpr double kRounding = 1e-5;
        for (std::size_t j = 0; j < joints.size(); ++j) {
            const auto node = static_cast<std::size_t>(&gltf_.item("nodes", joints[j]) -
                                                       gltf_.list("nodes").data());
            Matrix4 m = world_[node];
            if (inverse.rows() > 0) {
                const Eigen::Matrix<double, 16, 1> columns =
                    inverse.row(static_cast<long>(j)).transpose();
                m = m * Eigen::Map<const Matrix4>(columns.data());
            }
            if ((m - Matrix4::Identity()).cwiseAbs().maxCoeff() < kRounding) m.setIdentity();
            entry->second.push_back(m);
        }
        return entry->second;
    }

    void add_faces(const Primitive& primitive, int first, int count, int group, bool mirrored) {
        if (mesh_.corner_vertex.size() + primitive.corners.size() > kMostCorners)
            primitive.json.fail(kFewerCorners, "more");
        const JsonCursor attributes = primitive.json.at("attributes");
        int texture = -1;
        std::size_t set = 0;
        Eigen::Matrix<double, 2, 3> lay = Eigen::Matrix<double, 2, 3>::Identity();
        if (const auto reference = primitive.json.find("material"))
            texture = texture_of(gltf_.item("materials", *reference), set, lay);
        const std::string wanted = "TEXCOORD_" + std::to_string(set);
        const auto named = attributes.find(attributes.has(wanted) ? wanted : "TEXCOORD_0");
        Rows texcoords;
        if (named) {
            texcoords = gltf_.rows(gltf_.item("accessors", *named), 2);
            any_texcoord_ = true;
        } else {
            texture = -1;
        }
        // A mirroring transform turns faces inside out. Their corners are listed backwards to undo it.
        for (std::size_t t = 0; t + 2 < primitive.corners.size(); t += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index index = primitive.corners[t + (mirrored ? 2 - k : k)];
                if (static_cast<int>(index) >= count)
                    primitive.json.fail("indices of its vertices", std::to_string(index));
                mesh_.corner_vertex.push_back(first + static_cast<int>(index));
                Vec2 at(0, 0);
                if (index < texcoords.rows()) {
                    const Vec2 stored = texcoords.row(index).transpose();
                    if (stored.allFinite()) at = lay * stored.homogeneous();
                    // v points down in glTF.
                    at.y() = static_cast<double>(1.0F - static_cast<float>(at.y()));
                }
                texcoords_.push_back(at);
            }
            mesh_.face_begin.push_back(static_cast<int>(mesh_.corner_vertex.size()));
            mesh_.face_group.push_back(group);
            mesh_.face_texture.push_back(texture);
        }
    }

    /// The index of the colour picture of a material, -1 without one; its set of coordinates, and how it is laid on them
    /// (KHR_texture_transform).
    int texture_of(const JsonCursor& material, std::size_t& set, Eigen::Matrix<double, 2, 3>& lay) {
        const auto surface = material.find("pbrMetallicRoughness");
        const auto info = surface ? surface->find("baseColorTexture") : std::nullopt;
        if (!info) return -1;
        set = whole_number(*info, "texCoord", 0);
        if (const auto extensions = info->find("extensions"))
            if (const auto moved = extensions->find("KHR_texture_transform")) {
                set = whole_number(*moved, "texCoord", set);
                const auto pair = [&](const char* key, double value) {
                    const auto list = moved->find(key);
                    return list ? numbers_of(*list, 2) : std::vector<double>{value, value};
                };
                const auto offset = pair("offset", 0), scale = pair("scale", 1);
                const auto turn = moved->find("rotation");
                const double angle = turn ? turn->number() : 0;
                // Counter-clockwise where v points down
                lay << std::cos(angle) * scale[0], std::sin(angle) * scale[1], offset[0],
                    -std::sin(angle) * scale[0], std::cos(angle) * scale[1], offset[1];
            }
        const JsonCursor& texture = gltf_.item("textures", info->at("index"));
        auto source = texture.find("source");
        if (const auto extensions = texture.find("extensions"); !source && extensions)
            if (const auto webp = extensions->find("EXT_texture_webp"))
                source = webp->find("source");
        if (!source) return -1;
        const JsonCursor& image = gltf_.item("images", *source);
        const auto [entry, is_new] =
            texture_at_.try_emplace(image.place(), static_cast<int>(mesh_.textures.size()));
        if (is_new) add_texture(image, name_of(material));
        return entry->second;
    }

    void add_texture(const JsonCursor& image, const std::string& material) {
        geom::Texture out{{}, file_.string() + ":material \"" + material + "\"", {}};
        if (const auto view = image.find("bufferView")) {
            out.embedded = gltf_.bytes_of_view(gltf_.item("bufferViews", *view));
        } else {
            const std::string uri = image.at("uri").string();
            if (uri.starts_with("data:"))
                out.embedded = bytes_of_data_uri(uri, image.at("uri"));
            else
                out.file = places_.find(file_.parent_path(), path_of_uri(uri).string());
        }
        mesh_.textures.push_back(std::move(out));
    }

    static std::string group_name(const JsonCursor& node, std::size_t node_index,
                                  const std::vector<Primitive>& primitives, std::size_t p) {
        std::string name = name_of(node);
        if (name.empty()) name = "nodes[" + std::to_string(node_index) + "]";
        if (primitives.size() > 1)
            name +=
                "." + (primitives[p].material.empty() ? std::to_string(p) : primitives[p].material);
        return name;
    }

    /// Two nodes with the same name stay two groups.
    int new_group(const std::string& name) {
        std::string unique = name;
        for (int& n = last_of_name_.try_emplace(name, 1).first->second;
             !names_.insert(unique).second;)
            unique = name + "." + std::to_string(++n);
        mesh_.group_names.push_back(unique);
        return static_cast<int>(mesh_.group_names.size()) - 1;
    }

    static constexpr std::size_t kMostCompared =
        100;  // primitives of a mesh with copies of vertices

    std::filesystem::path file_;
    GltfFile gltf_;
    geom::PolygonMesh mesh_;
    std::vector<Matrix4> world_;      ///< of each node
    std::vector<std::size_t> order_;  ///< nodes of the scene
    std::set<std::size_t> wanted_;
    std::map<std::string, std::vector<Matrix4>> joints_;
    std::vector<Vec3> positions_;
    std::vector<Vec2> texcoords_;
    bool any_texcoord_ = false;
    std::set<std::string> names_;
    std::map<std::string, int> last_of_name_;
    std::map<std::string, int> texture_at_;
    PicturePlaces places_;
};

}  // namespace

geom::PolygonMesh read_gltf_mesh(const std::filesystem::path& file) {
    return MeshOfGltf(file).read();
}

}  // namespace risorius::io::detail
