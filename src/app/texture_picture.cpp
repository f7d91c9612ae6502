#include "app/texture_picture.h"

#include "core/error.h"
#include "media/picture_file.h"

namespace risorius::app {

Image read_texture(const geom::Texture& texture) {
    if (!texture.embedded.empty()) return media::read_picture(texture.embedded, texture.named_in);
    if (!std::filesystem::exists(texture.file))
        throw Error(texture.named_in, "the picture " + texture.file.string(), "no such file");
    return media::read_picture(texture.file);
}

}  // namespace risorius::app
