// SPDX-License-Identifier: MIT
/// \file
/// The hair of a head as other programs get it: a node Hair below the joint Head with cards over a cap (render/hair_cards.h). Its
/// shapes move every card with the skin that it grows on.
#pragma once

#include "risorius/io/morph_model.h"
#include "risorius/rig/head.h"
#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {

/// Adds the hair of the rig's appearance to a model of morph_head(), nothing for a shaven head. Call it when the model has its
/// targets. Those that move the skin below it get vertices of the hair.
void add_hair(const scene::RigFiles& files, const rig::Head& head, io::MorphModel& model);

}  // namespace risorius::blendshapes
