// SPDX-License-Identifier: MIT
#include "risorius/core/read_file.h"

#include <algorithm>

#include "risorius/core/error.h"
#include "risorius/core/file_reader.h"

namespace risorius {

namespace {

template <typename Bytes>
Bytes read_all(const std::filesystem::path& file, const FileKind& kind) {
    constexpr std::size_t kBlock = 1 << 16;
    FileReader in(file, kind);
    Bytes bytes;
    // One byte more than the size of a regular file shows its end without growing.
    std::size_t room = in.is_regular() ? static_cast<std::size_t>(in.size()) + 1 : kBlock;
    for (std::size_t used = 0;;) {
        bytes.resize(used + room);
        const std::size_t got = in.read(bytes.data() + used, room);
        used += got;
        if (used > kind.max_bytes) in.fail_as_too_large("more than that");
        if (got < room) {
            bytes.resize(used);
            return bytes;
        }
        room = std::max(kBlock, std::min<std::size_t>(used, kind.max_bytes));
    }
}

}  // namespace

std::string read_file(const std::filesystem::path& file, const FileKind& kind) {
    return read_all<std::string>(file, kind);
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file, const FileKind& kind) {
    return read_all<std::vector<std::uint8_t>>(file, kind);
}

void check_file(const std::filesystem::path& file, const FileKind& kind) {
    const FileReader opened(file, kind);
    if (!opened.is_regular())
        throw Error(file.string(), std::string(kind.name) + " that is not a pipe", "a pipe");
}

}  // namespace risorius
