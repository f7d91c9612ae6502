// SPDX-License-Identifier: MIT
/// \file
/// Unpacks blocks that zlib packed, as those of compressed files of VTK.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace risorius::io::detail {

/// Appends what `packed` holds to `out`. Returns an empty text, or what is wrong with the block: also when it holds more than `most_bytes`
/// or another checksum. No more memory is asked for than is filled.
std::string inflate(std::string_view packed, std::size_t most_bytes, std::string& out);

}  // namespace risorius::io::detail
