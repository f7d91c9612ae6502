// SPDX-License-Identifier: MIT
/// \file
/// Reads a whole file into memory. All input goes through here, so that each reader has the same guarantees:
/// - It reads regular files and pipes. A folder, a device such as /dev/zero, or a socket is an Error.
/// - A file above the limit of its kind is an Error, and at most the limit is read from a pipe that does not end.
/// - An error of the operating system in the middle of the file is an Error with its reason. It is never taken for the end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace risorius {

/// How messages call a kind of file, and its greatest size.
struct FileKind {
    std::string_view name;  ///< with its article: "a JSON file"
    std::uint64_t max_bytes;
};

inline constexpr std::uint64_t kMegabyte = 1'000'000;  ///< bytes

/// The bytes of a file, which may be empty. Throws Error with the path as its place.
std::string read_file(const std::filesystem::path& file, const FileKind& kind);

/// As read_file(), for formats that are not text.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file, const FileKind& kind);

/// Throws Error when read_file() would refuse the file before it reads. For files that a library opens by their name. Such a
/// library may open a file twice, therefore a pipe is an Error here.
void check_file(const std::filesystem::path& file, const FileKind& kind);

}  // namespace risorius
