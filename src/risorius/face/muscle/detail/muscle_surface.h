// SPDX-License-Identifier: MIT
/// \file
/// The muscles as closed surfaces for drawing. Each follows its fibres, or the bones that it spans.
///
/// Frame: the head frame, m. All muscles share one vertex array.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::face {

/// The surface of one muscle; it has several pieces when the muscle has several bands.
struct MuscleSurface {
    std::string muscle;
    std::optional<Side> side;  ///< empty: the muscle crosses the midline
    int column = -1;           ///< of the activation vector
    Triangles triangles;       ///< into the shared vertices, counter-clockwise from outside
};

/// What is constant while the vertices move.
struct MuscleSurfaces {
    std::vector<MuscleSurface> muscles;
    Points rest;  ///< V x 3
    TexCoords
        fibre;  ///< V x 2, position along and across the fibres at rest, m; each piece has its own origin
    std::vector<double> tendon;  ///< V, 0: muscle, 1: tendon

    /// Returns the surface of a muscle and creates it if there is none.
    MuscleSurface& of(const std::string& muscle, std::optional<Side> side, int column);
    /// Appends vertices, and triangles that are numbered from the first of them.
    void add(MuscleSurface& muscle, const Points& vertices, const TexCoords& along_across,
             const std::vector<double>& tendon_fraction, const Triangles& triangles);
};

}  // namespace risorius::face
