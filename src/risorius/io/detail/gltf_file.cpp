// SPDX-License-Identifier: MIT
#include "risorius/io/detail/gltf_file.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "risorius/core/json_text.h"
#include "risorius/core/text_lines.h"
#include "risorius/io/detail/base64_digit.h"
#include "risorius/io/detail/mesh_limits.h"

namespace risorius::io::detail {

namespace fs = std::filesystem;

namespace {

using Byte = std::uint8_t;

constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::size_t kMostJson = 256 * kMegabyte;  // buffers may be inside of it
constexpr std::size_t kMostValues = 3'000'000;      // in the JSON
constexpr std::size_t kMostBuffers = 1000;
// An accessor may be used several times, and a sparse one stands for many zeros.
constexpr double kNumbersPerByte = 50, kNumbersAtLeast = 1e6;
// The codec of meshoptimizer makes at most about 64 bytes of one.
constexpr std::size_t kUnpackedPerByte = 100;

enum Component { kByte = 5120, kUByte, kShort, kUShort, kUInt = 5125, kFloat };

std::uint32_t little_endian(const std::vector<Byte>& bytes, std::size_t at) {
    return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[at + 2]) << 16 |
           static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

/// Parsed JSON takes up to 64 bytes for each value.
void check_value_count(const std::string& text, const fs::path& name) {
    const auto values = static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return c == ',' || c == '[' || c == '{'; }));
    if (values > kMostValues)
        throw Error(name.string(), "at most 3 million values in its JSON", std::to_string(values));
}

std::size_t bytes_of(int component) {
    switch (component) {
        case kByte:
        case kUByte:
            return 1;
        case kShort:
        case kUShort:
            return 2;
        default:
            return 4;
    }
}

template <typename T>
T value_at(const Byte* data) {
    T value;
    std::memcpy(&value, data, sizeof value);
    return value;
}

/// The largest value of a component; "normalized" numbers are divided by it.
double largest(int component) {
    switch (component) {
        case kByte:
            return 127;
        case kUByte:
            return 255;
        case kShort:
            return 32767;
        case kUShort:
            return 65535;
        default:
            return 1;
    }
}

double number_at(const Byte* data, int component) {
    switch (component) {
        case kByte:
            return value_at<std::int8_t>(data);
        case kUByte:
            return *data;
        case kShort:
            return value_at<std::int16_t>(data);
        case kUShort:
            return value_at<std::uint16_t>(data);
        case kUInt:
            return value_at<std::uint32_t>(data);
        default:
            return static_cast<double>(value_at<float>(data));
    }
}

int width_of(const std::string& type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4") return 4;
    if (type == "MAT4") return 16;
    return 0;
}

}  // namespace

/// Equally spaced numbers in memory.
struct GltfFile::Numbers {
    const Byte* data;  ///< null: all are zero
    std::size_t count, stride;
    int component, width;
    bool normalized;

    double at(std::size_t row, int k) const {
        const double number = number_at(
            data + row * stride + static_cast<std::size_t>(k) * bytes_of(component), component);
        return normalized ? std::max(-1.0, number / largest(component)) : number;
    }
};

std::size_t whole_number(const JsonCursor& object, const char* key, std::size_t otherwise) {
    const auto found = object.find(key);
    if (!found) return otherwise;
    constexpr double kMost = 1e15;  // all whole numbers up to it are doubles
    const double value = found->number({0, kMost});
    if (value != std::floor(value)) found->fail("a whole number");
    return static_cast<std::size_t>(value);
}

std::vector<Byte> bytes_of_data_uri(const std::string& uri, const JsonCursor& place) {
    const std::size_t comma = uri.find(',');
    constexpr std::string_view kBase64 = ";base64";
    if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(kBase64))
        place.fail("a data URI in base64", "another");
    std::vector<Byte> out;
    out.reserve((uri.size() - comma) / 4 * 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (std::size_t i = comma + 1; i < uri.size() && uri[i] != '='; ++i) {
        const int digit = base64_digit(uri[i]);
        if (digit < 0) place.fail("letters of base64", "another");
        bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xffffff;
        if (count += 6; count >= 8) {
            count -= 8;
            out.push_back(static_cast<Byte>(bits >> count));
        }
    }
    return out;
}

fs::path path_of_uri(const std::string& uri) {
    const auto hex = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        return -1;
    };
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool coded = uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) >= 0 &&
                           hex(uri[i + 2]) >= 0 && (uri[i + 1] != '0' || uri[i + 2] != '0');
        out += coded ? static_cast<char>(hex(uri[i + 1]) * 16 + hex(uri[i + 2])) : uri[i];
        if (coded) i += 2;
    }
    return out;
}

GltfFile::GltfFile(const fs::path& file, const std::string& what, bool binary_only)
    : json_(JsonCursor::from_json(Json::object(), file.string())) {
    std::vector<Byte> binary;
    read_container(file, what, binary_only, binary);
    if (!json_.is_object()) json_.fail("an object");
    check_extensions();
    const std::string version = json_.at("asset").at("version").string();
    if (!version.starts_with("2.")) json_.at("asset").at("version").fail("version 2");
    read_buffers(file, binary);
    double size = 0;
    for (const Buffer& buffer : buffers_) size += static_cast<double>(buffer.bytes.size());
    may_read_ = kNumbersAtLeast + kNumbersPerByte * size;
}

void GltfFile::read_container(const fs::path& file, const std::string& what, bool binary_only,
                              std::vector<Byte>& binary) {
    const std::string name = file.string();
    const FileKind kind{what, kMeshFile.max_bytes};
    check_file(file, kind);
    std::vector<Byte> bytes = read_bytes(file, kind);
    if (bytes.empty()) throw Error(name, what, "nothing in it");
    const bool is_binary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
    std::string text;
    if (!is_binary) {
        const auto first = std::find_if(bytes.begin(), bytes.end(), [](Byte c) { return c > ' '; });
        // A byte-order mark begins with 0xEF.
        if (binary_only || first == bytes.end() || (*first != '{' && *first < 0x80))
            throw Error(name, what, "another kind of file");
        text = text_of_bytes(std::string(bytes.begin(), bytes.end()), name);
    } else {
        constexpr std::size_t kHeader = 12, kChunkHeader = 8;
        if (bytes.size() < kHeader + kChunkHeader || little_endian(bytes, 8) > bytes.size())
            throw Error(name, what, "one cut short");
        if (const auto version = little_endian(bytes, 4); version != 2)
            throw Error(name, "glTF of version 2", "version " + std::to_string(version));
        for (std::size_t at = kHeader, chunk = 0; at + kChunkHeader <= bytes.size(); ++chunk) {
            const std::size_t length = little_endian(bytes, at),
                              type = little_endian(bytes, at + 4);
            at += kChunkHeader;
            if (length > bytes.size() - at) throw Error(name, what, "one cut short");
            if (chunk == 0 && type != kJsonChunk)
                throw Error(name, "JSON in the first chunk", "another kind");
            const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
            const auto end = begin + static_cast<std::ptrdiff_t>(length);
            if (chunk == 0) text.assign(begin, end);
            if (chunk == 1 && type == kBinaryChunk) binary.assign(begin, end);
            at += length;
        }
    }
    bytes = {};
    if (text.size() > kMostJson)
        throw Error(name, "JSON of at most 256 MB", std::to_string(text.size()) + " bytes");
    check_value_count(text, file);
    json_ = parse_json_text(text, file);
}

void GltfFile::check_extensions() const {
    const auto required = json_.find("extensionsRequired");
    if (!required) return;
    constexpr std::array<std::string_view, 8> kRead{
        "EXT_meshopt_compression", "KHR_mesh_quantization", "KHR_texture_transform",
        "EXT_texture_webp",        "KHR_lights_punctual",   "KHR_animation_pointer",
        "KHR_xmp_json_ld",         "KHR_node_visibility"};
    for (const JsonCursor& name : required->items()) {
        const std::string extension = name.string();
        // These only say how a surface looks.
        if (extension.starts_with("KHR_materials_") ||
            std::find(kRead.begin(), kRead.end(), extension) != kRead.end())
            continue;
        name.fail("extensions that are read here (export the mesh without this one)",
                  in_quotes(extension));
    }
}

void GltfFile::read_buffers(const fs::path& file, std::vector<Byte>& binary) {
    const auto& listed = list("buffers");
    if (listed.size() > kMostBuffers)
        json_.at("buffers").fail("at most " + std::to_string(kMostBuffers) + " buffers",
                                 std::to_string(listed.size()));
    std::size_t total = 0;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const JsonCursor& buffer = listed[i];
        Buffer read;
        if (const auto uri = buffer.find("uri")) {
            const std::string text = uri->string();
            if (text.starts_with("data:")) {
                read.bytes = bytes_of_data_uri(text, *uri);
            } else {
                const fs::path beside = file.parent_path() / path_of_uri(text);
                constexpr FileKind kBuffer{"the buffer of a glTF file", kMeshFile.max_bytes};
                check_file(beside, kBuffer);
                read.bytes = read_bytes(beside, kBuffer);
            }
            read.is_there = true;
        } else if (i == 0) {
            read.bytes = std::move(binary);
            read.is_there = true;
        }
        // Without a URI: a place for what EXT_meshopt_compression unpacks.
        const std::size_t length = whole_number(buffer, "byteLength", 0);
        if (read.is_there && length > read.bytes.size())
            buffer.fail(std::to_string(length) + " bytes", std::to_string(read.bytes.size()));
        if (read.is_there) read.bytes.resize(length);
        if (total += read.bytes.size(); total > kMeshFile.max_bytes)
            buffer.fail("at most 1000 MB in all buffers", "more");
        buffers_.push_back(std::move(read));
    }
}

const std::vector<JsonCursor>& GltfFile::list(const std::string& name) const {
    const auto [entry, is_new] = lists_.try_emplace(name);
    if (is_new)
        if (const auto found = json_.find(name)) entry->second = found->items();
    return entry->second;
}

const JsonCursor& GltfFile::item(const std::string& name, const JsonCursor& reference) const {
    const auto& items = list(name);
    const int index = reference.integer(0, std::numeric_limits<int>::max());
    if (static_cast<std::size_t>(index) >= items.size())
        reference.fail("one of the " + std::to_string(items.size()) + " " + name);
    return items[static_cast<std::size_t>(index)];
}

GltfFile::Bytes GltfFile::range(const JsonCursor& place) const {
    const JsonCursor& listed = item("buffers", place.at("buffer"));
    const auto index = static_cast<std::size_t>(&listed - list("buffers").data());
    const Buffer& buffer = buffers_[index];
    if (!buffer.is_there) place.fail("a buffer with bytes", "one without a URI");
    const std::size_t offset = whole_number(place, "byteOffset", 0),
                      length = whole_number(place, "byteLength", 0);
    if (offset > buffer.bytes.size() || length > buffer.bytes.size() - offset)
        place.fail("bytes within the " + std::to_string(buffer.bytes.size()) + " of its buffer",
                   "bytes " + std::to_string(offset) + " to " + std::to_string(offset + length));
    return {buffer.bytes.data() + offset, length, whole_number(place, "byteStride", 0)};
}

GltfFile::Bytes GltfFile::view(const JsonCursor& view) const {
    if (const auto extensions = view.find("extensions"))
        if (const auto packed = extensions->find("EXT_meshopt_compression")) {
            const std::vector<Byte>& bytes = unpacked(view, *packed);
            const std::size_t stride = whole_number(view, "byteStride", 0);
            return {bytes.data(), bytes.size(), stride};
        }
    return range(view);
}

const std::vector<Byte>& GltfFile::unpacked(const JsonCursor& view,
                                            const JsonCursor& packed) const {
    const auto [entry, is_new] = unpacked_.try_emplace(view.place());
    if (!is_new) return entry->second;
    const Bytes from = range(packed);
    const std::size_t count = whole_number(packed, "count", 0), stride = from.stride;
    if (stride == 0 || stride > 256) packed.at("byteStride").fail("1 to 256 bytes");
    if (count > kUnpackedPerByte * (from.size + 100) / stride)
        packed.at("count").fail("no more than " + std::to_string(from.size) + " bytes can hold");
    const std::string mode = packed.at("mode").one_of({"ATTRIBUTES", "TRIANGLES", "INDICES"});
    const auto filter = packed.find("filter");
    const std::string how =
        filter ? filter->one_of({"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}) : "NONE";
    // The decoders are asked for what their documentation allows, see meshoptimizer.h.
    const bool whole = mode == "ATTRIBUTES"
                           ? stride % 4 == 0
                           : (stride == 2 || stride == 4) && (mode == "INDICES" || count % 3 == 0);
    if (!whole) packed.at("byteStride").fail("a size that fits the mode " + mode);
    std::vector<Byte>& out = entry->second;
    out.resize(count * stride);
    const int problem =
        mode == "ATTRIBUTES"
            ? meshopt_decodeVertexBuffer(out.data(), count, stride, from.data, from.size)
        : mode == "TRIANGLES"
            ? meshopt_decodeIndexBuffer(out.data(), count, stride, from.data, from.size)
            : meshopt_decodeIndexSequence(out.data(), count, stride, from.data, from.size);
    if (problem != 0) packed.fail("data that meshoptimizer can unpack", "others");
    if (how == "OCTAHEDRAL" && (stride == 4 || stride == 8))
        meshopt_decodeFilterOct(out.data(), count, stride);
    else if (how == "QUATERNION" && stride == 8)
        meshopt_decodeFilterQuat(out.data(), count, stride);
    else if (how == "EXPONENTIAL" && stride % 4 == 0)
        meshopt_decodeFilterExp(out.data(), count, stride);
    else if (how != "NONE")
        filter->fail("a filter that fits " + std::to_string(stride) + " bytes");
    return out;
}

std::vector<Byte> GltfFile::bytes_of_view(const JsonCursor& place) const {
    const Bytes bytes = view(place);
    spend(place, bytes.size, 1);
    return {bytes.data, bytes.data + bytes.size};
}

void GltfFile::spend(const JsonCursor& place, std::size_t count, int width) const {
    may_read_ -= static_cast<double>(count) * width;
    if (may_read_ < 0 || count > kMostCorners)
        place.fail("no more numbers than a file of its size holds",
                   std::to_string(count) + " elements");
}

std::size_t GltfFile::count(const JsonCursor& accessor) const {
    return whole_number(accessor, "count", 0);
}

GltfFile::Numbers GltfFile::values_in(const JsonCursor& place, const JsonCursor& accessor,
                                      int width, std::size_t count) const {
    const int component = accessor.at("componentType").integer(kByte, kFloat);
    if (component == 5124) accessor.at("componentType").fail("a type of components that glTF has");
    const auto flag = accessor.find("normalized");
    const Bytes bytes = view(item("bufferViews", place.at("bufferView")));
    const std::size_t offset = whole_number(place, "byteOffset", 0),
                      element = bytes_of(component) * static_cast<std::size_t>(width),
                      stride = bytes.stride == 0 ? element : bytes.stride;
    if (count == 0) return {nullptr, 0, 0, kFloat, width, false};
    if (stride < element || stride > 1 << 16)
        place.fail("elements beside each other", "a byteStride of " + std::to_string(stride));
    // `count` is at most kMostCorners here, so that no product overflows.
    if (offset > bytes.size || (count - 1) * stride + element > bytes.size - offset)
        place.fail(std::to_string(count) + " elements within its buffer view",
                   "a view of " + std::to_string(bytes.size) + " bytes");
    return {bytes.data + offset,
            count,
            stride,
            component,
            width,
            flag && flag->boolean() && component != kFloat && component != kUInt};
}

GltfFile::Numbers GltfFile::numbers(const JsonCursor& accessor, int width) const {
    if (width_of(accessor.at("type").string()) != width)
        accessor.at("type").fail(std::to_string(width) + " numbers for each element");
    const std::size_t elements = count(accessor);
    spend(accessor, elements, width);
    if (!accessor.has("bufferView")) return {nullptr, elements, 0, kFloat, width, false};
    return values_in(accessor, accessor, width, elements);
}

Rows GltfFile::rows(const JsonCursor& accessor, int width) const {
    const Numbers from = numbers(accessor, width);
    Rows out = Rows::Zero(static_cast<long>(from.count), width);
    if (from.data != nullptr)
        for (std::size_t i = 0; i < from.count; ++i)
            for (int k = 0; k < width; ++k) out(static_cast<long>(i), k) = from.at(i, k);
    if (accessor.has("sparse")) {
        const SparseRows changed = listed_rows(accessor, width);
        for (std::size_t i = 0; i < changed.row.size(); ++i)
            out.row(changed.row[i]) = changed.values.row(static_cast<long>(i));
    }
    return out;
}

SparseRows GltfFile::some_rows(const JsonCursor& accessor, int width) const {
    if (!accessor.has("bufferView")) return listed_rows(accessor, width);
    SparseRows out;
    out.values = rows(accessor, width);
    for (long i = 0; i < out.values.rows(); ++i) out.row.push_back(static_cast<std::uint32_t>(i));
    return out;
}

SparseRows GltfFile::listed_rows(const JsonCursor& accessor, int width) const {
    SparseRows out;
    out.values.resize(0, width);
    const auto sparse = accessor.find("sparse");
    if (!sparse) return out;
    if (width_of(accessor.at("type").string()) != width)
        accessor.at("type").fail(std::to_string(width) + " numbers for each element");
    const std::size_t elements = count(accessor), listed = whole_number(*sparse, "count", 0);
    if (listed > elements)
        sparse->at("count").fail("at most the " + std::to_string(elements) + " of its accessor");
    spend(*sparse, listed, width + 1);
    const JsonCursor at = sparse->at("indices");
    const Numbers rows = values_in(at, at, 1, listed),
                  values = values_in(sparse->at("values"), accessor, width, listed);
    if (listed > 0 && rows.component != kUByte && rows.component != kUShort &&
        rows.component != kUInt)
        at.at("componentType").fail("whole numbers of at least 0");
    out.values.resize(static_cast<long>(listed), width);
    for (std::size_t i = 0; i < listed; ++i) {
        const double row = rows.at(i, 0);
        if (!(row < static_cast<double>(elements)))
            at.fail("a sparse index within its accessor", format_number(row));
        out.row.push_back(static_cast<std::uint32_t>(row));
        for (int k = 0; k < width; ++k) out.values(static_cast<long>(i), k) = values.at(i, k);
    }
    return out;
}

std::vector<std::uint32_t> GltfFile::indices(const JsonCursor& accessor) const {
    const Rows numbers_read = rows(accessor, 1);
    std::vector<std::uint32_t> out;
    out.reserve(static_cast<std::size_t>(numbers_read.rows()));
    for (long i = 0; i < numbers_read.rows(); ++i) {
        const double number = numbers_read(i, 0);
        if (!(number >= 0 && number <= 4294967295.0) || number != std::floor(number))
            accessor.fail("whole numbers of at least 0", format_number(number));
        out.push_back(static_cast<std::uint32_t>(number));
    }
    return out;
}

}  // namespace risorius::io::detail
