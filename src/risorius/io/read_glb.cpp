// SPDX-License-Identifier: MIT
// Reads binary glTF (tinygltf), as written by write_glb.cpp.
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "risorius/core/error.h"
#include "risorius/io/morph_model.h"

namespace risorius::io {

namespace {

Json json_of(const tinygltf::Value& value) {
    if (value.IsObject()) {
        Json out = Json::object();
        for (const std::string& key : value.Keys()) out[key] = json_of(value.Get(key));
        return out;
    }
    if (value.IsArray()) {
        Json out = Json::array();
        for (std::size_t i = 0; i < value.ArrayLen(); ++i)
            out.push_back(json_of(value.Get(static_cast<int>(i))));
        return out;
    }
    if (value.IsString()) return value.Get<std::string>();
    if (value.IsBool()) return value.Get<bool>();
    if (value.IsInt()) return value.Get<int>();
    if (value.IsReal()) return value.Get<double>();
    return {};
}

class Unpacker {
  public:
    Unpacker(const tinygltf::Model& model, std::string place)
        : model_(model), place_(std::move(place)) {}

    /// The numbers of an accessor, one row per element.
    Eigen::MatrixXf floats(int index, int width) const {
        const tinygltf::Accessor& accessor = at(model_.accessors, index, "accessor");
        const bool whole = accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT;
        if ((accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !whole) ||
            accessor.normalized ||
            tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)) != width)
            fail("accessor " + std::to_string(index) + " of " + std::to_string(width) +
                     " floats, or whole numbers of 16 bits",
                 "another kind");
        const auto number = [&](int view, std::size_t offset, std::size_t i) {
            return whole ? static_cast<float>(read<short>(view, offset, i))
                         : read<float>(view, offset, i);
        };
        Eigen::MatrixXf out = Eigen::MatrixXf::Zero(static_cast<long>(accessor.count), width);
        if (accessor.bufferView >= 0)
            for (std::size_t i = 0; i < accessor.count; ++i)
                for (int k = 0; k < width; ++k)
                    out(static_cast<long>(i), k) =
                        number(accessor.bufferView, accessor.byteOffset,
                               i * static_cast<std::size_t>(width) + static_cast<std::size_t>(k));
        if (accessor.sparse.isSparse)
            for (std::size_t i = 0; i < static_cast<std::size_t>(accessor.sparse.count); ++i) {
                const std::size_t row = index_at(
                    accessor.sparse.indices.componentType, accessor.sparse.indices.bufferView,
                    static_cast<std::size_t>(accessor.sparse.indices.byteOffset), i);
                if (row >= accessor.count) fail("a sparse index within its accessor", "one beyond");
                for (int k = 0; k < width; ++k)
                    out(static_cast<long>(row), k) =
                        number(accessor.sparse.values.bufferView,
                               static_cast<std::size_t>(accessor.sparse.values.byteOffset),
                               i * static_cast<std::size_t>(width) + static_cast<std::size_t>(k));
            }
        return out;
    }
    std::vector<std::size_t> indices(int index) const {
        const tinygltf::Accessor& accessor = at(model_.accessors, index, "accessor");
        std::vector<std::size_t> out;
        for (std::size_t i = 0; i < accessor.count; ++i)
            out.push_back(
                index_at(accessor.componentType, accessor.bufferView, accessor.byteOffset, i));
        return out;
    }
    [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
        throw Error(place_, expected, found);
    }
    template <typename T>
    const T& at(const std::vector<T>& list, int index, const char* what) const {
        if (index < 0 || static_cast<std::size_t>(index) >= list.size())
            fail(std::string("every ") + what + " it refers to", "none");
        return list[static_cast<std::size_t>(index)];
    }

  private:
    template <typename T>
    T read(int view_index, std::size_t offset, std::size_t i) const {
        const tinygltf::BufferView& view = at(model_.bufferViews, view_index, "buffer view");
        const tinygltf::Buffer& buffer = at(model_.buffers, view.buffer, "buffer");
        if (view.byteStride != 0 && view.byteStride % sizeof(T) != 0)
            fail("numbers packed together", "others between them");
        const std::size_t from = view.byteOffset + offset + i * sizeof(T);
        if (from + sizeof(T) > view.byteOffset + view.byteLength ||
            from + sizeof(T) > buffer.data.size())
            fail("as many numbers as its accessors say", "fewer");
        T value;
        std::memcpy(&value, buffer.data.data() + from, sizeof(T));
        return value;
    }
    std::size_t index_at(int type, int view, std::size_t offset, std::size_t i) const {
        switch (type) {
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                return read<unsigned char>(view, offset, i);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                return read<unsigned short>(view, offset, i);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
                return read<unsigned>(view, offset, i);
            default:
                fail("indices that are whole numbers", "others");
        }
    }

    const tinygltf::Model& model_;
    std::string place_;
};

tinygltf::Model load_model(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!std::filesystem::exists(file))
        throw Error(file.string(), "a binary glTF file", "no such file");
    if (!in) throw Error(file.string(), "a binary glTF file", "one that cannot be read");
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in),
                                  std::istreambuf_iterator<char>()};
    tinygltf::Model model;
    std::string error, warning;
    tinygltf::TinyGLTF reader;
    if (bytes.empty() || bytes.size() > std::numeric_limits<unsigned>::max() ||
        !reader.LoadBinaryFromMemory(&model, &error, &warning,
                                     reinterpret_cast<const unsigned char*>(bytes.data()),
                                     static_cast<unsigned>(bytes.size())))
        throw Error(
            file.string(), "a binary glTF file",
            bytes.empty() ? "nothing in it"
            : std::string_view(bytes.data(), std::min<std::size_t>(4, bytes.size())) != "glTF"
                ? "another kind of file"
                : error.substr(0, error.find('\n')));
    return model;
}

// Scale of the one node that shows the mesh, m. It is the same along every axis.
double unit_of(const tinygltf::Model& model, const Unpacker& from) {
    double unit_m = 1;
    for (const tinygltf::Node& node : model.nodes)
        if (node.mesh == 0 && node.scale.size() == 3) {
            unit_m = node.scale[0];
            if (!(unit_m > 0) || node.scale[1] != unit_m || node.scale[2] != unit_m)
                from.fail("a node with one scale along all axes", "another");
        }
    return unit_m;
}

// Writes the displacements of each target, in the order of vertices.
void write_targets(const std::vector<std::map<int, Vec3>>& deltas, MorphModel& out) {
    for (std::size_t t = 0; t < deltas.size(); ++t) {
        MorphTarget& target = out.targets[t];
        target.delta.resize(static_cast<long>(deltas[t].size()), 3);
        for (const auto& [v, delta] : deltas[t]) {
            target.delta.row(static_cast<long>(target.vertex.size())) = delta.transpose();
            target.vertex.push_back(v);
        }
    }
}

// Reads the weights of all shapes over time.
MorphAnimation read_animation(const Unpacker& from, const tinygltf::Animation& animation,
                              std::size_t targets) {
    const tinygltf::AnimationSampler& sampler =
        from.at(animation.samplers, animation.channels[0].sampler, "sampler");
    const Eigen::MatrixXf times = from.floats(sampler.input, 1),
                          weights = from.floats(sampler.output, 1);
    MorphAnimation made;
    made.name = animation.name;
    if (times.rows() > 1) made.fps = 1.0 / static_cast<double>(times(1, 0) - times(0, 0));
    const long count = static_cast<long>(targets);
    if (weights.rows() != times.rows() * count)
        from.fail("a weight for every shape and frame", std::to_string(weights.rows()));
    made.weights.resize(times.rows(), count);
    for (long i = 0; i < weights.rows(); ++i) made.weights(i / count, i % count) = weights(i, 0);
    return made;
}

}  // namespace

MorphModel read_glb(const std::filesystem::path& file) {
    const tinygltf::Model model = load_model(file);
    const Unpacker from(model, file.string());
    if (model.meshes.size() != 1)
        from.fail("one mesh with blend shapes, as risorius shapes writes it",
                  std::to_string(model.meshes.size()) + " meshes");
    const tinygltf::Mesh& mesh = model.meshes[0];
    const double unit_m = unit_of(model, from);

    MorphModel out;
    out.name = mesh.name;
    out.extras = json_of(mesh.extras);
    if (!out.extras.is_object() || !out.extras.contains("targetNames"))
        from.fail("the names of its shapes in the mesh's extras", "none");
    for (const Json& name : out.extras["targetNames"])
        out.targets.push_back({name.get<std::string>(), {}, {}});
    out.extras.erase("targetNames");

    // Merges the primitives into one list of vertices. Those at seams occur several times, at the same position.
    std::vector<std::map<int, Vec3>> deltas(out.targets.size());
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        const auto number = primitive.attributes.find("_VERTEX");
        const auto position = primitive.attributes.find("POSITION");
        if (number == primitive.attributes.end() || position == primitive.attributes.end())
            from.fail("the attributes POSITION and _VERTEX, as risorius shapes writes them",
                      "neither or one");
        if (primitive.targets.size() != out.targets.size())
            from.fail("a target for each of its " + std::to_string(out.targets.size()) + " names",
                      std::to_string(primitive.targets.size()));
        const Eigen::MatrixXf numbers = from.floats(number->second, 1),
                              at = from.floats(position->second, 3);
        if (numbers.rows() != at.rows() || at.rows() == 0 || !(numbers.minCoeff() >= 0) ||
            !(numbers.maxCoeff() < 1e7f))
            from.fail("a vertex number for every vertex", "others");
        const long max = static_cast<long>(numbers.maxCoeff()) + 1;
        if (max > out.vertices.rows()) {
            const long before = out.vertices.rows();
            out.vertices.conservativeResize(max, 3);
            out.vertices.bottomRows(max - before).setZero();
        }
        const auto vertex = [&](long i) { return static_cast<int>(numbers(i, 0)); };
        for (long i = 0; i < at.rows(); ++i)
            out.vertices.row(vertex(i)) = unit_m * at.row(i).cast<double>();
        MorphPart part;
        if (primitive.material >= 0)
            part.name = from.at(model.materials, primitive.material, "material").name;
        const std::vector<std::size_t> corners = from.indices(primitive.indices);
        part.triangles.resize(static_cast<long>(corners.size() / 3), 3);
        for (long c = 0; c < 3 * part.triangles.rows(); ++c) {
            const std::size_t corner = corners[static_cast<std::size_t>(c)];
            if (corner >= static_cast<std::size_t>(at.rows()))
                from.fail("triangles of its vertices", "one beyond them");
            part.triangles(c / 3, c % 3) = vertex(static_cast<long>(corner));
        }
        out.parts.push_back(std::move(part));
        for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
            const auto moved = primitive.targets[t].find("POSITION");
            if (moved == primitive.targets[t].end()) continue;
            const Eigen::MatrixXf delta = from.floats(moved->second, 3);
            for (long i = 0; i < std::min(delta.rows(), at.rows()); ++i)
                if (!delta.row(i).isZero(0.0f))
                    deltas[t][vertex(i)] = unit_m * delta.row(i).transpose().cast<double>();
        }
    }
    write_targets(deltas, out);
    for (const tinygltf::Animation& animation : model.animations)
        if (!animation.channels.empty() && animation.channels[0].target_path == "weights")
            out.animations.push_back(read_animation(from, animation, out.targets.size()));
    return out;
}

}  // namespace risorius::io
