// SPDX-License-Identifier: MIT
#include "risorius/animate/detail/read_checksums.h"

#include "risorius/core/error.h"
#include "risorius/core/sha256.h"

namespace risorius::animate {

namespace fs = std::filesystem;

ReadChecksums::ReadChecksums()
    : observer_([this](const fs::path& file, const void* bytes, std::size_t size) {
          Sha256 sha;
          sha.add(bytes, size);
          note(file, sha.finish());
      }) {}

InputFile ReadChecksums::of(const fs::path& file) {
    const auto seen = sums_.find(file);
    if (seen != sums_.end()) return {file, seen->second};
    const std::string sha256 = sha256_of_file(file);
    sums_.emplace(file, sha256);
    return {file, sha256};
}

void ReadChecksums::note(const fs::path& file, const std::string& sha256) {
    const auto [known, is_new] = sums_.emplace(file, sha256);
    if (!is_new && known->second != sha256)
        throw RunError(file.string() + ": the file changed while it was read");
}

}  // namespace risorius::animate
