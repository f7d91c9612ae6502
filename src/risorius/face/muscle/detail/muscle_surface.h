// The muscles as closed surfaces, for looking at them: each follows its fibres, or the bones that it spans.
//
// Frame: the head frame, m. All muscles share one vertex array.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::face {

/// One muscle; several pieces when it has several bands.
struct MuscleSurface {
    std::string muscle;
    std::optional<Side> side;  ///< none: across the midline
    int column = -1;           ///< of the activation vector
    Triangles triangles;       ///< into the shared vertices, counter-clockwise from outside
};

/// What stays as it is while the vertices move.
struct MuscleSurfaces {
    std::vector<MuscleSurface> muscles;
    Points rest;  ///< V x 3
    TexCoords
        fibre;  ///< V x 2, along and across the fibres at rest, m; each piece with its own zero
    std::vector<double> tendon;  ///< V, 0 flesh, 1 tendon

    /// The surface of a muscle, made when there is none yet.
    MuscleSurface& of(const std::string& muscle, std::optional<Side> side, int column);
    /// Puts the vertices, and the triangles that count from the first of them, after what is there.
    void add(MuscleSurface& muscle, const Points& vertices, const TexCoords& along_across,
             const std::vector<double>& tendon_share, const Triangles& triangles);
};

}  // namespace risorius::face
