// SPDX-License-Identifier: MIT
#include "risorius/media/detail/temporary_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include "risorius/core/error.h"
#include "risorius/core/read_file.h"

namespace risorius::media::detail {

std::vector<unsigned char> read_whole(const std::filesystem::path& file, const char* expected) {
    return risorius::read_bytes(file, {expected, 2000 * kMegabyte});
}

}  // namespace risorius::media::detail
