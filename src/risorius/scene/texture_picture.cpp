// SPDX-License-Identifier: MIT
#include "risorius/scene/texture_picture.h"

#include "risorius/core/error.h"
#include "risorius/media/picture_file.h"

namespace risorius::scene {

Image read_texture(const geom::Texture& texture) {
    if (!texture.embedded.empty()) return media::read_picture(texture.embedded, texture.named_in);
    if (!std::filesystem::exists(texture.file))
        throw Error(texture.named_in, "the picture " + texture.file.string(), "no such file");
    return media::read_picture(texture.file);
}

}  // namespace risorius::scene
