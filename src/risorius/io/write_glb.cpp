// SPDX-License-Identifier: MIT
// Writes binary glTF (tinygltf): nodes, parts with the vertices they need, morph targets as sparse accessors, animations.
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "risorius/core/error.h"
#include "risorius/io/detail/gltf_packer.h"
#include "risorius/io/detail/part_vertices.h"
#include "risorius/io/detail/target_normals.h"
#include "risorius/io/morph_model.h"

namespace risorius::io {

namespace {

constexpr double kMaxWhole = 32767, kMaxShare = 65535;  // of 16 bits, with and without a sign
constexpr double kMaxByte = 127;                        // of 8 bits, with a sign

using detail::Floats;
using detail::PartVertices;
using detail::TargetFields;
using Packer = detail::GltfPacker;
using detail::value_of;

float linear_of_srgb(double value) {
    return static_cast<float>(value <= 0.04045 ? value / 12.92
                                               : std::pow((value + 0.055) / 1.055, 2.4));
}

/// Numbers as integers in multiples of a unit.
template <typename T>
std::vector<T> whole(const Floats& values, double unit) {
    std::vector<T> out;
    for (const float value : values)
        out.push_back(static_cast<T>(std::lround(static_cast<double>(value) / unit)));
    return out;
}

// The morph targets of a part. Targets that do not move it share one accessor.
class PartTargets {
  public:
    /// `unit`: displacement of the integer 1, m; 0: displacements stay floats.
    PartTargets(Packer& packer, const PartVertices& part, double unit)
        : packer_(packer), part_(part), unit_(unit) {}

    int positions(const Points& field) {
        return unit_ > 0 ? add<short>(field, unit_, true, still_place_)
                         : add<float>(field, 1, true, still_place_);
    }
    int normals(const Points& field) { return add<float>(field, 1, false, still_normal_); }

  private:
    template <typename T>
    int add(const Points& field, double unit, bool with_range, int& still) {
        std::vector<unsigned> at;
        std::vector<T> values;
        for (unsigned i = 0; i < part_.count(); ++i) {
            const auto row = field.row(part_.vertex[i]);
            if (row.isZero(0.0)) continue;
            at.push_back(i);
            for (int k = 0; k < 3; ++k)
                values.push_back(static_cast<T>(
                    std::is_integral_v<T> ? static_cast<double>(std::lround(row[k] / unit))
                                          : row[k]));
        }
        if (!at.empty())
            return packer_.sparse(std::move(at), std::move(values), part_.count(), with_range);
        if (still < 0) still = packer_.sparse<T>({}, {}, part_.count(), with_range);
        return still;
    }

    Packer& packer_;
    const PartVertices& part_;
    double unit_;
    int still_place_ = -1, still_normal_ = -1;
};

tinygltf::Material material_of(const MorphPart& part) {
    tinygltf::Material out;
    out.name = part.name;
    out.doubleSided = part.see_both_sides;
    out.pbrMetallicRoughness.baseColorFactor = {linear_of_srgb(part.colour[0]),
                                                linear_of_srgb(part.colour[1]),
                                                linear_of_srgb(part.colour[2]), part.opacity};
    if (part.opacity < 1 || part.picture_cuts) out.alphaMode = "BLEND";
    if (part.picture_cuts && part.cut_at > 0) {
        out.alphaMode = "MASK";
        out.alphaCutoff = part.cut_at;
    }
    if (part.picture >= 0) out.pbrMetallicRoughness.baseColorTexture.index = part.picture;
    out.pbrMetallicRoughness.metallicFactor = 0;
    out.pbrMetallicRoughness.roughnessFactor = part.roughness;
    return out;
}

/// What of the targets a mesh has: all for the first one, else those that move its vertices.
std::vector<std::size_t> targets_of(const MorphModel& model, const std::vector<char>& is_here,
                                    bool first) {
    std::vector<std::size_t> out;
    for (std::size_t t = 0; t < model.targets.size(); ++t) {
        const std::vector<int>& moved = model.targets[t].vertex;
        if (first || std::any_of(moved.begin(), moved.end(),
                                 [&](int v) { return is_here[static_cast<std::size_t>(v)] != 0; }))
            out.push_back(t);
    }
    return out;
}

class GlbWriter {
  public:
    explicit GlbWriter(const MorphModel& model)
        : model_(model), nodes_(model.nodes), packer_(out_) {
        if (nodes_.empty()) nodes_.push_back({.name = model.name});
        double largest = 0;
        for (const MorphTarget& target : model.targets)
            if (target.delta.size() > 0)
                largest = std::max(largest, target.delta.cwiseAbs().maxCoeff());
        for (const MorphPart& part : model.parts)
            for (const int v : part.triangles.reshaped())
                largest = std::max(largest, place_in(part, v).cwiseAbs().maxCoeff());
        // Positions use the same unit, and the scale of the node converts both to metres.
        unit_ = model.whole_numbers ? largest / kMaxWhole : 0;
        normals_ = detail::vertex_normals(model, model.vertices);
        parts_ = detail::parts_by_turn(model, normals_);
    }

    std::string bytes() {
        out_.asset.version = "2.0";
        out_.asset.generator = "Risorius";
        if (unit_ > 0) out_.extensionsUsed = out_.extensionsRequired = {"KHR_mesh_quantization"};
        add_nodes();
        add_pictures();
        for (const detail::TurningPart& one : parts_) vertices_.emplace_back(one.part);
        for (std::size_t n = 0; n < nodes_.size(); ++n) add_mesh(static_cast<int>(n));
        add_targets();
        add_skin();
        for (const MorphAnimation& animation : model_.animations) add_animation(animation);
        std::ostringstream bytes;
        tinygltf::TinyGLTF writer;
        if (!writer.WriteGltfSceneToStream(&out_, bytes, false, true))
            throw RunError("the glTF of " + model_.name + " cannot be written");
        return bytes.str();
    }

  private:
    /// A vertex from the origin of the node of a part, m.
    Vec3 place_in(const MorphPart& part, int v) const {
        return model_.vertices.row(v).transpose() -
               nodes_[static_cast<std::size_t>(part.node)].place;
    }

    /// A mesh, the parts in it, and its targets.
    struct Mesh {
        int node;
        std::vector<std::size_t> parts, targets;
    };

    void add_nodes() {
        tinygltf::Scene scene;
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            const MorphNode& from = nodes_[n];
            tinygltf::Node node;
            node.name = from.name;
            if (!from.extras.is_null()) node.extras = value_of(from.extras);
            Vec3 place = from.place;
            if (from.parent < 0) {
                scene.nodes.push_back(static_cast<int>(n));
            } else {
                const auto parent = static_cast<std::size_t>(from.parent);
                place -= nodes_[parent].place;
                out_.nodes[parent].children.push_back(static_cast<int>(n));
            }
            if (!place.isZero(0.0)) node.translation = {place.x(), place.y(), place.z()};
            out_.nodes.push_back(node);
        }
        out_.scenes.push_back(scene);
        out_.defaultScene = 0;
    }

    void add_pictures() {
        if (model_.pictures.empty()) return;
        for (const MorphPicture& picture : model_.pictures) {
            tinygltf::Image image;
            image.name = picture.name;
            image.mimeType = picture.mime_type;
            image.bufferView = packer_.picture(picture.bytes);
            tinygltf::Texture texture;
            texture.source = static_cast<int>(out_.images.size());
            texture.sampler =
                sampler(repeats(texture.source) ? TINYGLTF_TEXTURE_WRAP_REPEAT
                                                : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE);
            out_.images.push_back(image);
            out_.textures.push_back(texture);
        }
    }

    /// The sampler that wraps so, with mipmaps.
    int sampler(int wrap) {
        tinygltf::Sampler made;
        made.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
        made.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
        made.wrapS = made.wrapT = wrap;
        const auto known = std::find(out_.samplers.begin(), out_.samplers.end(), made);
        const auto index = static_cast<int>(known - out_.samplers.begin());
        if (known == out_.samplers.end()) out_.samplers.push_back(made);
        return index;
    }

    /// Whether texture coordinates beyond the border show a picture again.
    bool repeats(int picture) const {
        return std::any_of(model_.parts.begin(), model_.parts.end(), [&](const MorphPart& part) {
            return part.picture == picture && part.texcoords.rows() > 0 &&
                   (part.texcoords.minCoeff() < 0 || part.texcoords.maxCoeff() > 1);
        });
    }

    /// The material of a part. Parts that look the same share it.
    int material(const MorphPart& part) {
        const tinygltf::Material made = material_of(part);
        const auto known = std::find(out_.materials.begin(), out_.materials.end(), made);
        if (known == out_.materials.end()) out_.materials.push_back(made);
        return static_cast<int>(std::find(out_.materials.begin(), out_.materials.end(), made) -
                                out_.materials.begin());
    }

    /// The parts of a node.
    void add_mesh(int node) {
        Mesh made{node, {}, {}};
        std::vector<char> is_here(static_cast<std::size_t>(model_.vertices.rows()), 0);
        tinygltf::Mesh mesh;
        mesh.name = nodes_[static_cast<std::size_t>(node)].name;
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            if (parts_[p].part.node != node) continue;
            made.parts.push_back(p);
            for (const int v : vertices_[p].vertex) is_here[static_cast<std::size_t>(v)] = 1;
            mesh.primitives.push_back(primitive(p));
        }
        if (made.parts.empty()) return;
        if (nodes_[static_cast<std::size_t>(node)].has_shapes)
            made.targets = targets_of(model_, is_here, meshes_.empty());
        mesh.weights.assign(made.targets.size(), 0.0);
        Json extras = meshes_.empty() && model_.extras.is_object() ? model_.extras : Json::object();
        if (!made.targets.empty() || meshes_.empty()) extras["targetNames"] = Json::array();
        for (const std::size_t t : made.targets)
            extras["targetNames"].push_back(model_.targets[t].name);
        if (!extras.empty()) mesh.extras = value_of(extras);
        tinygltf::Node& shown = out_.nodes[static_cast<std::size_t>(node)];
        shown.mesh = static_cast<int>(out_.meshes.size());
        if (unit_ > 0 && node != model_.skin.node) shown.scale.assign(3, unit_);
        out_.meshes.push_back(mesh);
        meshes_.push_back(std::move(made));
    }

    tinygltf::Primitive primitive(std::size_t p) {
        const MorphPart& part = parts_[p].part;
        const PartVertices& own = vertices_[p];
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = material(part);
        primitive.indices = packer_.indices(own.corner, own.count());
        constexpr int kVertexData = TINYGLTF_TARGET_ARRAY_BUFFER;
        const Points places = model_.vertices.rowwise() -
                              nodes_[static_cast<std::size_t>(part.node)].place.transpose();
        const Floats at = own.gather(places), normals = own.gather(normals_);
        primitive.attributes["POSITION"] =
            unit_ == 0 ? packer_.floats(at, TINYGLTF_TYPE_VEC3, true, kVertexData)
                       : packer_.integers(whole<short>(at, unit_), 3, false, true);
        primitive.attributes["NORMAL"] =
            unit_ == 0
                ? packer_.floats(normals, TINYGLTF_TYPE_VEC3, false, kVertexData)
                : packer_.integers(whole<signed char>(normals, 1 / kMaxByte), 3, true, false);
        if (own.vertex.front() < model_.first_worn())
            primitive.attributes["_VERTEX"] =
                packer_.floats(Floats(own.vertex.begin(), own.vertex.end()), TINYGLTF_TYPE_SCALAR,
                               false, kVertexData);
        if (part.texcoords.rows() > 0) {
            Floats coordinates;
            for (const auto& [u, v] : own.texcoord) {
                coordinates.push_back(static_cast<float>(u));
                coordinates.push_back(static_cast<float>(1 - v));  // glTF measures from the top
            }
            const auto [low, high] = std::minmax_element(coordinates.begin(), coordinates.end());
            primitive.attributes["TEXCOORD_0"] =
                unit_ > 0 && *low >= 0 && *high <= 1
                    ? packer_.integers(whole<unsigned short>(coordinates, 1 / kMaxShare), 2, true,
                                       false)
                    : packer_.floats(coordinates, TINYGLTF_TYPE_VEC2, false, kVertexData);
        }
        if (part.tint.rows() > 0) {
            std::vector<unsigned char> colours;  // with an opacity of 1
            for (const int v : own.vertex)
                for (long k = 0; k < 4; ++k)
                    colours.push_back(static_cast<unsigned char>(
                        k < 3 ? std::lround(255 * linear_of_srgb(part.tint(v, k))) : 255));
            primitive.attributes["COLOR_0"] = packer_.quadruples(colours, true);
        }
        if (part.node == model_.skin.node) add_joints(own, primitive);
        return primitive;
    }

    /// The joints of each vertex, and their shares, which sum to 1: in 65535ths, of whole numbers in 255ths.
    void add_joints(const PartVertices& own, tinygltf::Primitive& primitive) {
        const long all = unit_ > 0 ? 255 : 65535;
        std::vector<unsigned char> joints, small;
        std::vector<unsigned short> shares;
        for (const int v : own.vertex) {
            const Eigen::RowVectorXd weights = model_.skin.weights.row(v);
            long left = all, largest = 0;
            for (long j = 0; j < 4; ++j) {
                const long share =
                    j < weights.size() ? std::lround(static_cast<double>(all) * weights[j]) : 0;
                joints.push_back(static_cast<unsigned char>(share > 0 ? j : 0));
                shares.push_back(static_cast<unsigned short>(share));
                left -= share;
                if (j < weights.size() && weights[j] > weights[largest]) largest = j;
            }
            auto& most = shares[shares.size() - 4 + static_cast<std::size_t>(largest)];
            most = static_cast<unsigned short>(most + left);
        }
        primitive.attributes["JOINTS_0"] = packer_.quadruples(joints, false);
        if (unit_ > 0) small.assign(shares.begin(), shares.end());
        primitive.attributes["WEIGHTS_0"] =
            unit_ > 0 ? packer_.quadruples(small, true) : packer_.quadruples(shares, true);
    }

    void add_targets() {
        unsigned most = 0;
        for (const PartVertices& part : vertices_) most = std::max(most, part.count());
        if (!model_.targets.empty() && most > 0 && unit_ == 0) packer_.make_zeros(most);
        std::vector<PartTargets> targets;
        for (const PartVertices& part : vertices_) targets.emplace_back(packer_, part, unit_);
        for (std::size_t t = 0; t < model_.targets.size(); ++t) {
            const TargetFields fields(model_, model_.targets[t], normals_);
            for (std::size_t m = 0; m < meshes_.size(); ++m) {
                const Mesh& mesh = meshes_[m];
                if (!std::binary_search(mesh.targets.begin(), mesh.targets.end(), t)) continue;
                for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
                    PartTargets& part = targets[mesh.parts[i]];
                    auto& made = out_.meshes[m].primitives[i].targets.emplace_back();
                    made["POSITION"] = part.positions(fields.delta);
                    if (parts_[mesh.parts[i]].turns) made["NORMAL"] = part.normals(fields.turn);
                }
            }
        }
    }

    void add_skin() {
        if (model_.skin.node < 0) return;
        tinygltf::Skin skin;
        skin.name = nodes_[static_cast<std::size_t>(model_.skin.node)].name;
        skin.joints = model_.skin.joints;
        Floats to_joints;
        const double unit = unit_ > 0 ? unit_ : 1;
        for (const int joint : model_.skin.joints) {
            Eigen::Matrix4d to_joint = Eigen::Matrix4d::Identity();
            to_joint.topLeftCorner<3, 3>() *= unit;
            to_joint.topRightCorner<3, 1>() = -nodes_[static_cast<std::size_t>(joint)].place;
            for (long k = 0; k < 16; ++k)
                to_joints.push_back(static_cast<float>(to_joint(k % 4, k / 4)));
        }
        skin.inverseBindMatrices = packer_.floats(to_joints, TINYGLTF_TYPE_MAT4, false);
        out_.skins.push_back(skin);
        out_.nodes[static_cast<std::size_t>(model_.skin.node)].skin = 0;
    }

    void add_animation(const MorphAnimation& animation) {
        tinygltf::Animation made;
        made.name = animation.name;
        Floats times;
        for (long f = 0; f < animation.weights.rows(); ++f)
            times.push_back(static_cast<float>(static_cast<double>(f) / animation.fps));
        const int input = packer_.floats(times, TINYGLTF_TYPE_SCALAR, true);
        const auto add = [&](int node, const char* path, const Floats& values, int type) {
            tinygltf::AnimationSampler sampler;
            sampler.interpolation = "LINEAR";
            sampler.input = input;
            const bool within = std::all_of(values.begin(), values.end(),
                                            [](float value) { return value >= 0 && value <= 1; });
            sampler.output = unit_ > 0 && type == TINYGLTF_TYPE_SCALAR && within
                                 ? packer_.shares(whole<unsigned short>(values, 1 / kMaxShare))
                                 : packer_.floats(values, type, false);
            tinygltf::AnimationChannel channel;
            channel.sampler = static_cast<int>(made.samplers.size());
            channel.target_node = node;
            channel.target_path = path;
            made.samplers.push_back(sampler);
            made.channels.push_back(channel);
        };
        for (const Mesh& mesh : meshes_) {
            if (!nodes_[static_cast<std::size_t>(mesh.node)].animate_shapes) continue;
            Floats weights;
            bool moves = &mesh == &meshes_[0];
            for (long f = 0; f < animation.weights.rows(); ++f)
                for (const std::size_t t : mesh.targets) {
                    weights.push_back(animation.weights(f, static_cast<long>(t)));
                    moves = moves || weights.back() != 0;
                }
            if (moves && !weights.empty()) add(mesh.node, "weights", weights, TINYGLTF_TYPE_SCALAR);
        }
        for (const NodeMotion& motion : animation.motions) {
            const auto node = static_cast<std::size_t>(motion.node);
            Floats turns, places;
            for (const Eigen::Quaterniond& turn : motion.turn)
                for (const double value : {turn.x(), turn.y(), turn.z(), turn.w()})
                    turns.push_back(static_cast<float>(value));
            Vec3 rest = nodes_[node].place;
            if (nodes_[node].parent >= 0)
                rest -= nodes_[static_cast<std::size_t>(nodes_[node].parent)].place;
            for (const Vec3& shift : motion.shift)
                for (long k = 0; k < 3; ++k)
                    places.push_back(static_cast<float>(rest[k] + shift[k]));
            add(motion.node, "rotation", turns, TINYGLTF_TYPE_VEC4);
            if (!places.empty()) add(motion.node, "translation", places, TINYGLTF_TYPE_VEC3);
        }
        if (!made.channels.empty()) out_.animations.push_back(made);
    }

    const MorphModel& model_;
    std::vector<MorphNode> nodes_;
    double unit_ = 0;  ///< of positions, m; 0: they are floats in metres
    Points normals_;
    std::vector<detail::TurningPart> parts_;  ///< as they are written, one primitive each
    tinygltf::Model out_;
    Packer packer_;
    std::vector<PartVertices> vertices_;  ///< by part
    std::vector<Mesh> meshes_;
};

}  // namespace

std::string glb_bytes(const MorphModel& model) { return GlbWriter(model).bytes(); }

}  // namespace risorius::io
