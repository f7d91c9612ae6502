// SPDX-License-Identifier: MIT
#include "risorius/core/existing_file.h"

#include "risorius/core/stand_in.h"

namespace risorius {

std::filesystem::path existing_file(const JsonCursor& json) {
    const std::filesystem::path file = json.path();
    std::error_code failure;  // a name that is too long, or a loop of links
    if (!std::filesystem::exists(file_to_read(file), failure))
        json.fail("an existing file", "\"" + file.string() + "\"");
    return file;
}

}  // namespace risorius
