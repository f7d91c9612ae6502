// SPDX-License-Identifier: MIT
#include "risorius/scene/texture_picture.h"

#include "risorius/core/error.h"
#include "risorius/media/picture_file.h"

namespace risorius::scene {

Image read_texture(const geom::Texture& texture) {
    if (!texture.embedded.empty()) return media::read_picture(texture.embedded, texture.named_in);
    std::error_code ignored;  // a name that is too long, or a loop of links
    if (!std::filesystem::exists(texture.file, ignored))
        throw Error(texture.named_in, "the picture " + texture.file.string(), "no such file");
    return media::read_picture(texture.file);
}

}  // namespace risorius::scene
