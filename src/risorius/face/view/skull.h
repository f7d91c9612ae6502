// Skull and mandible of a head, estimated from its skin: the bones of the standard head warped by the landmarks, and cut back
// to where the tissue over them is as thick as the rig's table says (skull.json: means of Stephan and Simpson 2008, and later).
//
// For looking at; the simulation's own bone are the deep nodes of tissue_mesh.h, with the same thickness where that has any.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

struct BoneSurface {
    Points vertices;      ///< V x 3, m, head frame, at rest
    Triangles triangles;  ///< counter-clockwise from outside
    std::vector<double>
        open;  ///< V, 0..1: how much of the surroundings is seen, not closed in by bone
};

struct Skull {
    BoneSurface cranium;   ///< with the upper jaw
    BoneSurface mandible;  ///< at rest, where the mandible's motion starts from
};

/// Of a grid of `step_mm`, at atlas size; the usual one takes some seconds. Works on any placed head; teeth are those of its mesh, if
/// it has some.
Skull estimate_skull(const rig::Head& head, const rig::RigDescription& rig, double step_mm = 1.5);

}  // namespace risorius::face
