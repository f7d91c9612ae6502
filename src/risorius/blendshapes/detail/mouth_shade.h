// SPDX-License-Identifier: MIT
/// \file
/// How dark the inside of an open mouth is. Programs that draw a glTF file light teeth and tongue as they light the face, because
/// they do not know that lips and cheeks stand in the way. The colours of the parts tell them.
#pragma once

#include <array>

#include "risorius/io/morph_model.h"
#include "risorius/rig/head.h"

namespace risorius::blendshapes {

/// Sets MorphPart::tint of the wall of the mouth, teeth, gums and tongue to the share of the surroundings that each vertex sees
/// while the jaw is open; of teeth and gums while the lips bare them, if that is more. The jaw is open as the shape opens it that
/// lowers the lower teeth most; without such a shape, it is shut. The shapes must already be in the model.
void shade_mouth(const rig::Head& head, io::MorphModel& model);

}  // namespace risorius::blendshapes
