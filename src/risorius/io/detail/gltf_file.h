// SPDX-License-Identifier: MIT
/// \file
/// The parts of a glTF 2.0 file that hold numbers: buffers, views of them and accessors. What the file says is checked before
/// it is believed: every range lies within its bytes, and the work and the memory are proportional to the size of the file.
///
/// Read are .gltf with buffers beside or inside it, and .glb under any name (.vrm). Of extensions: EXT_meshopt_compression,
/// KHR_mesh_quantization and KHR_texture_transform. Others that a file requires are an Error with their name, except those
/// that only change how a surface looks.
///
/// Source: glTF 2.0 specification, Khronos 2021, chapters 3.6 and 4.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"

namespace risorius::io::detail {

/// Numbers of an accessor, a row per element.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Some rows of an accessor, and their indices.
struct SparseRows {
    std::vector<std::uint32_t> row;  ///< each below the accessor's count
    Rows values;
};

/// A glTF file in memory. Functions throw Error that names the place in the JSON.
class GltfFile {
  public:
    /// Reads the file and the buffers that it names. `what` is how messages call the file: "a binary glTF file". With
    /// `binary_only`, a .gltf is an Error.
    GltfFile(const std::filesystem::path& file, const std::string& what, bool binary_only = false);

    const JsonCursor& json() const { return json_; }
    /// The items of a list at the root of the file, such as "nodes"; none when there is no such list.
    const std::vector<JsonCursor>& list(const std::string& name) const;
    /// The item of a list whose index stands at `reference`.
    const JsonCursor& item(const std::string& name, const JsonCursor& reference) const;

    /// The number of elements of an accessor.
    std::size_t count(const JsonCursor& accessor) const;
    /// All rows of an accessor with `width` numbers each. Integers that are "normalized" become -1 to 1 or 0 to 1.
    Rows rows(const JsonCursor& accessor, int width) const;
    /// The rows that may differ from zero; for a sparse accessor, those that it lists.
    SparseRows some_rows(const JsonCursor& accessor, int width) const;
    /// An accessor of unsigned whole numbers, one per element.
    std::vector<std::uint32_t> indices(const JsonCursor& accessor) const;
    /// The bytes of a buffer view, such as those of a picture.
    std::vector<std::uint8_t> bytes_of_view(const JsonCursor& view) const;
    /// Counts work on `count` items of `width` numbers. Throws Error at `place` when all that was counted is out of proportion to
    /// the size of the file: what a file lists once may be used by each of its nodes.
    void spend(const JsonCursor& place, std::size_t count, int width = 1) const;

  private:
    struct Bytes {
        const std::uint8_t* data = nullptr;
        std::size_t size = 0, stride = 0;
    };
    struct Buffer {
        std::vector<std::uint8_t> bytes;
        bool is_there = false;
    };
    struct Numbers;

    SparseRows listed_rows(const JsonCursor& accessor, int width) const;
    void read_container(const std::filesystem::path& file, const std::string& what,
                        bool binary_only, std::vector<std::uint8_t>& binary);
    void read_buffers(const std::filesystem::path& file, std::vector<std::uint8_t>& binary);
    void check_extensions() const;
    Bytes view(const JsonCursor& view) const;
    const std::vector<std::uint8_t>& unpacked(const JsonCursor& view,
                                              const JsonCursor& packed) const;
    Bytes range(const JsonCursor& place) const;
    Numbers numbers(const JsonCursor& accessor, int width) const;
    Numbers values_in(const JsonCursor& place, const JsonCursor& accessor, int width,
                      std::size_t count) const;

    JsonCursor json_;
    std::vector<Buffer> buffers_;
    mutable std::map<std::string, std::vector<JsonCursor>> lists_;
    /// By the place of the view
    mutable std::map<std::string, std::vector<std::uint8_t>> unpacked_;
    /// Numbers and items that may still be read, in proportion to the size of the file
    mutable double may_read_ = 0;
};

/// A whole number of at least 0 in the JSON; `otherwise` where the key is missing.
std::size_t whole_number(const JsonCursor& object, const char* key, std::size_t otherwise);

/// The bytes of a "data:" URI. Throws Error with the place.
std::vector<std::uint8_t> bytes_of_data_uri(const std::string& uri, const JsonCursor& place);

/// The path that a URI relative to a file means: "a%20b.bin" is "a b.bin".
std::filesystem::path path_of_uri(const std::string& uri);

}  // namespace risorius::io::detail
