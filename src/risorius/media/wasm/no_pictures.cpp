// SPDX-License-Identifier: MIT
// A page has no readers of pictures; the page shows those that `risorius view` has painted.
#include "risorius/core/error.h"
#include "risorius/media/picture_file.h"

namespace risorius::media {

Image read_picture(const std::filesystem::path& file) {
    throw Error(file.string(), "a mesh without pictures: this page reads none", "one");
}
Image read_picture(const std::vector<std::uint8_t>&, const std::string& place) {
    throw Error(place, "a mesh without pictures: this page reads none", "one");
}

}  // namespace risorius::media
