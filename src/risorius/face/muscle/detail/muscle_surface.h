// SPDX-License-Identifier: MIT
/// \file
/// The muscles as closed surfaces for drawing. A surface follows the fibres of its muscle, or the bones between which it lies.
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

/// The surfaces of all muscles of a face: everything that stays constant while the vertices move.
struct MuscleSurfaces {
    std::vector<MuscleSurface> muscles;
    Points rest;  ///< V x 3, m, at rest
    /// V x 2, position along and across the fibres at rest, m. Each piece has its own origin.
    TexCoords fibre;
    std::vector<double> tendon;  ///< V, 0..1; 0: muscle, 1: tendon

    /// Returns the surface of a muscle and creates it if there is none.
    MuscleSurface& of(const std::string& muscle, std::optional<Side> side, int column);
    /// Appends vertices with their data, and triangles to `muscle`. Index 0 of `triangles` is the first of the new vertices.
    void add(MuscleSurface& muscle, const Points& vertices, const TexCoords& along_across,
             const std::vector<double>& tendon_fraction, const Triangles& triangles);
};

}  // namespace risorius::face
