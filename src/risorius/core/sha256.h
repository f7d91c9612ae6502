// SPDX-License-Identifier: MIT
/// \file
/// SHA-256 of bytes and files, as lower-case hexadecimal digits. Run records use it to identify scripts, meshes and frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace risorius {

/// Computes the checksum of bytes that are added in pieces.
class Sha256 {
  public:
    Sha256();
    ~Sha256();
    Sha256(Sha256&&) noexcept;
    void add(const void* bytes, std::size_t count);
    std::string finish();  ///< 64 hexadecimal digits

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Returns the checksum of a file. Throws Error when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace risorius
