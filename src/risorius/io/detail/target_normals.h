// SPDX-License-Identifier: MIT
/// \file
/// Normals of a model, how its targets turn them, and which parts of it have normals in targets.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/io/morph_model.h"

namespace risorius::io::detail {

/// The normals of a model with these vertices, each of unit length.
Points vertex_normals(const MorphModel& model, const Points& vertices);

/// Dense fields of a target, indexed by vertex. `turn` is zero where nobody sees it.
struct TargetFields {
    Points delta, turn;
    TargetFields(const MorphModel& model, const MorphTarget& target, const Points& normals);
};

/// A part as it is written, and whether its targets have normals.
struct TurningPart {
    MorphPart part;
    bool turns;
};

/// The parts of a model as they are written. three.js keeps every target of a primitive dense, 16 bytes for each vertex, and as much
/// again if any of them has normals. So a part of a node with targets is cut in two where that saves enough: triangles with a corner whose
/// normal some target turns, and the others, whose targets have positions alone.
std::vector<TurningPart> parts_by_turn(const MorphModel& model, const Points& normals);

}  // namespace risorius::io::detail
