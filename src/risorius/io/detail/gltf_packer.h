// SPDX-License-Identifier: MIT
/// \file
/// Packs the numbers and pictures of a glTF file that is written into one binary buffer.
#pragma once

#include <tiny_gltf.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::io::detail {

using Floats = std::vector<float>;

/// JSON as the library of glTF holds it, for extras.
inline tinygltf::Value value_of(const Json& json) {
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

/// The one binary buffer of the file, and the accessors that refer to it.
class GltfPacker {
  public:
    explicit GltfPacker(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

    /// Makes the zeros under sparse accessors of up to `count` vectors. Some readers (Godot 3) take an accessor without a view
    /// for one of view 0; none of them reads KHR_mesh_quantization, so that files with it need no zeros. The stride lets vectors of 16-bit integers use the same view.
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
    /// Vectors of `width` integers of 8 or 16 bits, each on four bytes as vertex attributes have to be. "Normalized" ones run from -1
    /// or 0 to 1.
    template <typename T>
    int integers(const std::vector<T>& values, std::size_t width, bool normalized,
                 bool with_range) {
        static_assert(sizeof(T) <= 2);
        constexpr int kTypes[] = {TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
        tinygltf::Accessor accessor = described(values, kTypes[width - 2], with_range);
        accessor.normalized = normalized;
        constexpr std::size_t kInFour = 4 / sizeof(T);
        const std::size_t padded = (width + kInFour - 1) / kInFour * kInFour;
        std::vector<T> spread(values.size() / width * padded, T{0});
        for (std::size_t i = 0; i < values.size(); ++i)
            spread[i / width * padded + i % width] = values[i];
        accessor.bufferView = view(spread, TINYGLTF_TARGET_ARRAY_BUFFER);
        if (padded != width) model_.bufferViews.back().byteStride = padded * sizeof(T);
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
    /// accessors without numbers. `with_range`: with the least and the largest values, as positions need them.
    template <typename T>
    int sparse(std::vector<unsigned> at, std::vector<T> values, unsigned count, bool with_range) {
        if (at.empty()) {
            at = {0};
            values.assign(3, T{0});
        }
        std::vector<T> all = values;
        if (at.size() < count) all.insert(all.end(), 3, T{0});
        tinygltf::Accessor accessor = described(all, TINYGLTF_TYPE_VEC3, with_range);
        accessor.count = count;
        accessor.bufferView = zeros_;
        accessor.sparse.isSparse = true;
        accessor.sparse.count = static_cast<int>(at.size());
        // Many shapes move the same vertices.
        const auto [known, is_new] = moved_.try_emplace({count > kMostOfShort, at});
        if (is_new) known->second = index_view(at, count, 0);
        std::tie(accessor.sparse.indices.bufferView, accessor.sparse.indices.componentType) =
            known->second;
        accessor.sparse.indices.byteOffset = 0;
        accessor.sparse.values.bufferView = view(values, 0);
        accessor.sparse.values.byteOffset = 0;
        return add(accessor);
    }

    /// Numbers in 0 to 1 as 65535ths.
    int shares(const std::vector<unsigned short>& values) {
        tinygltf::Accessor accessor = described(values, TINYGLTF_TYPE_SCALAR, false);
        accessor.normalized = true;
        accessor.bufferView = view(values, 0);
        return add(accessor);
    }
    /// Whole numbers of a vertex, four of them: joints, or shares and colours that are "normalized"
    template <typename T>
    int quadruples(const std::vector<T>& values, bool normalized) {
        tinygltf::Accessor accessor = described(values, TINYGLTF_TYPE_VEC4, false);
        accessor.normalized = normalized;
        accessor.bufferView = view(values, TINYGLTF_TARGET_ARRAY_BUFFER);
        return add(accessor);
    }
    /// The bytes of a picture; returns the view.
    int picture(const std::string& bytes) {
        return view(std::vector<unsigned char>(bytes.begin(), bytes.end()), 0);
    }

  private:
    int add(const tinygltf::Accessor& accessor) {
        model_.accessors.push_back(accessor);
        return static_cast<int>(model_.accessors.size()) - 1;
    }
    template <typename T>
    static constexpr int component_type() {
        if (std::is_same_v<T, short>) return TINYGLTF_COMPONENT_TYPE_SHORT;
        if (std::is_same_v<T, unsigned short>) return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
        if (std::is_same_v<T, unsigned char>) return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
        if (std::is_same_v<T, signed char>) return TINYGLTF_COMPONENT_TYPE_BYTE;
        return TINYGLTF_COMPONENT_TYPE_FLOAT;
    }
    /// A number with few digits that is this float when it is read as one.
    static double shortest(float value) {
        char text[32];
        const auto end = std::to_chars(text, text + sizeof text, value).ptr;
        double out = value;
        std::from_chars(text, end, out);
        return out;
    }
    template <typename T>
    static tinygltf::Accessor described(const std::vector<T>& values, int type, bool with_range) {
        const auto width =
            static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
        tinygltf::Accessor accessor;
        accessor.componentType = component_type<T>();
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
        for (std::vector<double>* ends : {&accessor.minValues, &accessor.maxValues})
            for (double& end : *ends) end = shortest(static_cast<float>(end));
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
        if (vertices > kMostOfShort)
            return {view(values, target), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT};
        return {view(std::vector<unsigned short>(values.begin(), values.end()), target),
                TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT};
    }

    static constexpr unsigned kMostOfShort = 65534;

    tinygltf::Model& model_;
    /// The views of lists of vertices, and their types; with 32 bits or 16
    std::map<std::pair<bool, std::vector<unsigned>>, std::pair<int, int>> moved_;
    int zeros_ = -1;  ///< the view of zeros
};

}  // namespace risorius::io::detail
