// SPDX-License-Identifier: MIT
/// \file
/// Levels of detail of a mesh with blend shapes: fewer triangles over some of the same vertices, so that shapes, textures, joints and
/// animations follow. Borders between parts stay, so that no gaps open.
///
/// Source: Garland & Heckbert 1997, Surface simplification using quadric error metrics, as in meshoptimizer.
#pragma once

#include "risorius/io/level_error.h"
#include "risorius/io/morph_model.h"

namespace risorius::io {

/// Returns the model with about this fraction of its triangles. Small parts and what is worn keep
/// theirs.
MorphModel coarser_model(const MorphModel& model, double fraction);

LevelError level_error(const MorphModel& fine, const MorphModel& coarse);

}  // namespace risorius::io
