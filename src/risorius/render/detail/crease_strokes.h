// SPDX-License-Identifier: MIT
/// \file
/// The lines of an ageing face at rest, as strokes on the paint map: a dark valley with a light ridge beside it.
#pragma once

#include <vector>

#include "risorius/render/detail/paint_strokes.h"
#include "risorius/render/scene.h"

namespace risorius::render {

/// Returns the strokes; none with Appearance::age_lines 0. Lines whose landmarks are missing are left out.
std::vector<StrokeVertex> plan_creases(const Scene& scene, const Vec3& paint_centre);

}  // namespace risorius::render
