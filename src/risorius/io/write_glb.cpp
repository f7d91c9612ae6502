// SPDX-License-Identifier: MIT
// Writes binary glTF (tinygltf): parts with the vertices they need, morph targets as sparse accessors, animated weights.
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <type_traits>
#include <utility>

#include "risorius/core/error.h"
#include "risorius/io/morph_model.h"

namespace risorius::io {

namespace {

constexpr double kNoTurn = 0.035;    // change of a normal at weight 1; two degrees are not visible
constexpr double kMaxWhole = 32767;  // of 16 bits

using Floats = std::vector<float>;

Points vertex_normals(const MorphModel& model, const Points& vertices) {
    Points normals = Points::Zero(vertices.rows(), 3);
    const auto shared = [&](long v) {
        return model.stands_for.empty() ? v : model.stands_for[static_cast<std::size_t>(v)];
    };
    for (const MorphPart& part : model.parts)
        for (long f = 0; f < part.triangles.rows(); ++f) {
            const auto corner = [&](int k) -> Vec3 {
                return vertices.row(part.triangles(f, k)).transpose();
            };
            const Vec3 twice_area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
            for (int k = 0; k < 3; ++k)
                normals.row(shared(part.triangles(f, k))) += twice_area.transpose();
        }
    for (long v = 0; v < normals.rows(); ++v)
        if (shared(v) != v) normals.row(v) = normals.row(shared(v));
    for (long v = 0; v < normals.rows(); ++v) {
        const double length = normals.row(v).norm();
        if (length > 1e-20)
            normals.row(v) /= length;
        else
            normals.row(v) = Vec3::UnitZ().transpose();
    }
    return normals;
}

float linear_of_srgb(double value) {
    return static_cast<float>(value <= 0.04045 ? value / 12.92
                                               : std::pow((value + 0.055) / 1.055, 2.4));
}

tinygltf::Value value_of(const Json& json) {
    using Value = tinygltf::Value;
    if (json.is_object()) {
        Value::Object object;
        for (const auto& [key, value] : json.items()) object[key] = value_of(value);
        return Value(object);
    }
    if (json.is_array()) {
        Value::Array array;
        for (const Json& value : json) array.push_back(value_of(value));
        return Value(array);
    }
    if (json.is_string()) return Value(json.get<std::string>());
    if (json.is_boolean()) return Value(json.get<bool>());
    if (json.is_number_integer()) return Value(json.get<int>());
    if (json.is_number()) return Value(json.get<double>());
    return {};
}

// The one binary buffer of the file, and the accessors that refer to it.
class Packer {
  public:
    explicit Packer(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

    /// Makes the zeros under sparse accessors of up to `count` vectors. Some readers (Godot 3) take an accessor without a view
    /// for one of view 0. The stride lets vectors of 16-bit integers use the same view.
    void make_zeros(unsigned count) {
        zeros_ =
            view(Floats(3 * static_cast<std::size_t>(count), 0.f), TINYGLTF_TARGET_ARRAY_BUFFER);
        model_.bufferViews.back().byteStride = 3 * sizeof(float);
    }

    int floats(const Floats& values, int type, bool with_range, int target = 0) {
        tinygltf::Accessor accessor = described(values, type, with_range);
        accessor.bufferView = view(values, target);
        return add(accessor);
    }
    int indices(const std::vector<unsigned>& values, unsigned vertices) {
        tinygltf::Accessor accessor;
        accessor.type = TINYGLTF_TYPE_SCALAR;
        accessor.count = values.size();
        std::tie(accessor.bufferView, accessor.componentType) =
            index_view(values, vertices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        return add(accessor);
    }
    /// Writes `count` vectors that are zero except for the listed ones. At least one is listed, because some readers ignore
    /// accessors without numbers.
    template <typename T>
    int sparse(std::vector<unsigned> at, std::vector<T> values, unsigned count) {
        if (at.empty()) {
            at = {0};
            values.assign(3, T{0});
        }
        std::vector<T> all = values;
        if (at.size() < count) all.insert(all.end(), 3, T{0});
        tinygltf::Accessor accessor = described(all, TINYGLTF_TYPE_VEC3, true);
        accessor.count = count;
        accessor.bufferView = zeros_;
        accessor.sparse.isSparse = true;
        accessor.sparse.count = static_cast<int>(at.size());
        std::tie(accessor.sparse.indices.bufferView, accessor.sparse.indices.componentType) =
            index_view(at, count, 0);
        accessor.sparse.indices.byteOffset = 0;
        accessor.sparse.values.bufferView = view(values, 0);
        accessor.sparse.values.byteOffset = 0;
        return add(accessor);
    }

  private:
    int add(const tinygltf::Accessor& accessor) {
        model_.accessors.push_back(accessor);
        return static_cast<int>(model_.accessors.size()) - 1;
    }
    template <typename T>
    static tinygltf::Accessor described(const std::vector<T>& values, int type, bool with_range) {
        const auto width =
            static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
        tinygltf::Accessor accessor;
        accessor.componentType = std::is_same_v<T, short> ? TINYGLTF_COMPONENT_TYPE_SHORT
                                                          : TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.type = type;
        accessor.count = values.size() / width;
        if (!with_range) return accessor;
        accessor.minValues.assign(width, std::numeric_limits<double>::infinity());
        accessor.maxValues.assign(width, -std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < values.size(); ++i) {
            accessor.minValues[i % width] =
                std::min(accessor.minValues[i % width], static_cast<double>(values[i]));
            accessor.maxValues[i % width] =
                std::max(accessor.maxValues[i % width], static_cast<double>(values[i]));
        }
        return accessor;
    }
    template <typename T>
    int view(const std::vector<T>& values, int target) {
        std::vector<unsigned char>& bytes = model_.buffers[0].data;
        bytes.resize((bytes.size() + 3) / 4 * 4, 0);
        tinygltf::BufferView out;
        out.buffer = 0;
        out.byteOffset = bytes.size();
        out.byteLength = values.size() * sizeof(T);
        out.target = target;
        bytes.resize(bytes.size() + out.byteLength);
        if (!values.empty())
            std::memcpy(bytes.data() + out.byteOffset, values.data(), out.byteLength);
        model_.bufferViews.push_back(out);
        return static_cast<int>(model_.bufferViews.size()) - 1;
    }
    std::pair<int, int> index_view(const std::vector<unsigned>& values, unsigned vertices,
                                   int target) {
        if (vertices > 65534) return {view(values, target), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT};
        return {view(std::vector<unsigned short>(values.begin(), values.end()), target),
                TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT};
    }

    tinygltf::Model& model_;
    int zeros_ = -1;  ///< the view of zeros
};

// The vertices of a part: one for every vertex of the model that it uses, and one more for every further texture coordinate
// there.
struct PartVertices {
    std::vector<int> vertex;  ///< index in the model
    std::vector<std::array<double, 2>> texcoord;
    std::vector<unsigned> corner;  ///< 3F

    explicit PartVertices(const MorphPart& part) {
        using Key = std::pair<int, std::array<double, 2>>;
        const bool mapped = part.texcoords.rows() > 0;
        std::map<Key, unsigned> index;
        const auto key = [&](long c) {
            const std::array<double, 2> at =
                mapped ? std::array{part.texcoords(c, 0), part.texcoords(c, 1)}
                       : std::array{0.0, 0.0};
            return Key{part.triangles(c / 3, c % 3), at};
        };
        const long corners = 3 * part.triangles.rows();
        for (long c = 0; c < corners; ++c) index.emplace(key(c), 0);
        for (auto& [at, number] : index) {
            number = static_cast<unsigned>(vertex.size());
            vertex.push_back(at.first);
            texcoord.push_back(at.second);
        }
        for (long c = 0; c < corners; ++c) corner.push_back(index.at(key(c)));
    }
    unsigned count() const { return static_cast<unsigned>(vertex.size()); }
    Floats gather(const Points& of) const {
        Floats out;
        for (const int v : vertex)
            for (int k = 0; k < 3; ++k) out.push_back(static_cast<float>(of(v, k)));
        return out;
    }
};

/// Dense fields of a target, indexed by vertex.
struct TargetFields {
    Points delta, turn;
    TargetFields(const MorphModel& model, const MorphTarget& target, const Points& normals) {
        delta = Points::Zero(model.vertices.rows(), 3);
        for (std::size_t i = 0; i < target.vertex.size(); ++i)
            delta.row(target.vertex[i]) = target.delta.row(static_cast<long>(i));
        turn = vertex_normals(model, model.vertices + delta) - normals;
        for (long v = 0; v < turn.rows(); ++v)
            if (turn.row(v).norm() < kNoTurn) turn.row(v).setZero();
    }
};

// The morph targets of a part. Targets that do not move it share one accessor.
class PartTargets {
  public:
    /// `unit`: displacement of the integer 1, m; 0: displacements stay floats.
    PartTargets(Packer& packer, const PartVertices& part, double unit)
        : packer_(packer), part_(part), unit_(unit) {}

    int positions(const Points& field) {
        return unit_ > 0 ? add<short>(field, unit_, still_place_)
                         : add<float>(field, 1, still_place_);
    }
    int normals(const Points& field) { return add<float>(field, 1, still_normal_); }

  private:
    template <typename T>
    int add(const Points& field, double unit, int& still) {
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
        if (!at.empty()) return packer_.sparse(std::move(at), std::move(values), part_.count());
        if (still < 0) still = packer_.sparse<T>({}, {}, part_.count());
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
    if (part.opacity < 1) out.alphaMode = "BLEND";
    out.pbrMetallicRoughness.metallicFactor = 0;
    out.pbrMetallicRoughness.roughnessFactor = part.roughness;
    return out;
}

void add_animation(const MorphAnimation& animation, Packer& packer, tinygltf::Model& out) {
    Floats times, weights;
    for (long f = 0; f < animation.weights.rows(); ++f) {
        times.push_back(static_cast<float>(static_cast<double>(f) / animation.fps));
        for (long t = 0; t < animation.weights.cols(); ++t)
            weights.push_back(animation.weights(f, t));
    }
    tinygltf::AnimationSampler sampler;
    sampler.interpolation = "LINEAR";
    sampler.input = packer.floats(times, TINYGLTF_TYPE_SCALAR, true);
    sampler.output = packer.floats(weights, TINYGLTF_TYPE_SCALAR, false);
    tinygltf::AnimationChannel channel;
    channel.sampler = 0;
    channel.target_node = 0;
    channel.target_path = "weights";
    tinygltf::Animation made;
    made.name = animation.name;
    made.samplers.push_back(sampler);
    made.channels.push_back(channel);
    out.animations.push_back(made);
}

}  // namespace

std::string glb_bytes(const MorphModel& model) {
    tinygltf::Model out;
    out.asset.version = "2.0";
    out.asset.generator = "Risorius";
    Packer packer(out);
    double largest = 0;
    for (const MorphTarget& target : model.targets)
        if (target.delta.size() > 0)
            largest = std::max(largest, target.delta.cwiseAbs().maxCoeff());
    // Positions use the same unit, and the scale of the node converts both to metres.
    const double unit = model.whole_numbers ? largest / kMaxWhole : 0;
    if (unit > 0) out.extensionsUsed = out.extensionsRequired = {"KHR_mesh_quantization"};
    const Points normals = vertex_normals(model, model.vertices);
    std::vector<PartVertices> vertices;
    tinygltf::Mesh mesh;
    mesh.name = model.name;
    for (const MorphPart& part : model.parts) {
        const PartVertices& own = vertices.emplace_back(part);
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = static_cast<int>(out.materials.size());
        out.materials.push_back(material_of(part));
        primitive.indices = packer.indices(own.corner, own.count());
        constexpr int kVertexData = TINYGLTF_TARGET_ARRAY_BUFFER;
        const auto vectors = [&](const Points& of, bool with_range) {
            return packer.floats(own.gather(of), TINYGLTF_TYPE_VEC3, with_range, kVertexData);
        };
        primitive.attributes["POSITION"] =
            vectors(unit > 0 ? Points(model.vertices / unit) : model.vertices, true);
        primitive.attributes["NORMAL"] = vectors(normals, false);
        primitive.attributes["_VERTEX"] = packer.floats(
            Floats(own.vertex.begin(), own.vertex.end()), TINYGLTF_TYPE_SCALAR, false, kVertexData);
        if (part.texcoords.rows() > 0) {
            Floats coordinates;
            for (const auto& [u, v] : own.texcoord) {
                coordinates.push_back(static_cast<float>(u));
                coordinates.push_back(static_cast<float>(1 - v));  // glTF measures from the top
            }
            primitive.attributes["TEXCOORD_0"] =
                packer.floats(coordinates, TINYGLTF_TYPE_VEC2, false, kVertexData);
        }
        if (part.tint.rows() > 0)
            primitive.attributes["COLOR_0"] = vectors(part.tint.unaryExpr([](double value) {
                return static_cast<double>(linear_of_srgb(value));
            }),
                                                      false);
        mesh.primitives.push_back(primitive);
    }
    if (!model.targets.empty() && !vertices.empty())
        packer.make_zeros(std::max_element(vertices.begin(), vertices.end(),
                                           [](const PartVertices& a, const PartVertices& b) {
                                               return a.count() < b.count();
                                           })
                              ->count());
    std::vector<PartTargets> targets;
    for (const PartVertices& part : vertices) targets.emplace_back(packer, part, unit);
    for (const MorphTarget& target : model.targets) {
        const TargetFields fields(model, target, normals);
        for (std::size_t p = 0; p < vertices.size(); ++p)
            mesh.primitives[p].targets.push_back({{"POSITION", targets[p].positions(fields.delta)},
                                                  {"NORMAL", targets[p].normals(fields.turn)}});
    }
    mesh.weights.assign(model.targets.size(), 0.0);
    Json extras = model.extras.is_object() ? model.extras : Json::object();
    extras["targetNames"] = Json::array();
    for (const MorphTarget& target : model.targets) extras["targetNames"].push_back(target.name);
    mesh.extras = value_of(extras);
    out.meshes.push_back(mesh);
    tinygltf::Node node;
    node.name = model.name;
    node.mesh = 0;
    if (unit > 0) node.scale.assign(3, unit);
    out.nodes.push_back(node);
    for (const MorphAnimation& animation : model.animations) add_animation(animation, packer, out);
    tinygltf::Scene scene;
    scene.nodes.push_back(0);
    out.scenes.push_back(scene);
    out.defaultScene = 0;
    std::ostringstream bytes;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&out, bytes, false, true))
        throw RunError("the glTF of " + model.name + " cannot be written");
    return bytes.str();
}

}  // namespace risorius::io
