// SPDX-License-Identifier: MIT
#include "risorius/core/existing_file.h"

#include "risorius/core/stand_in.h"

namespace risorius {

std::filesystem::path existing_file(const JsonCursor& json) {
    const std::filesystem::path file = json.path();
    if (!std::filesystem::exists(file_to_read(file)))
        json.fail("an existing file", "\"" + file.string() + "\"");
    return file;
}

}  // namespace risorius
