// The scale of activation in the upper left corner of a picture: a bar of colours from 0 to 1, with its name.
#pragma once

#include "core/image.h"
#include "render/offscreen_view.h"

namespace risorius::render {

/// Colours are those of muscles in even light, under the skin of the face. Sizes go with the smaller side of the picture; writing that would be too small to read is left out.
void draw_activation_scale(const Look& look, const Background& background, Image& image);

}  // namespace risorius::render
