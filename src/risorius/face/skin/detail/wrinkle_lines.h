// SPDX-License-Identifier: MIT
/// \file
/// Where skin folds and in which direction: the usual lines of expression of a face, across the muscles that fold them.
///
///   f   phase over the rest surface, valleys at whole numbers        m   direction of the fibres, unit
///   l   distance of the lines (wavelength)            w   window: 1 where the lines belong, 0 elsewhere
///
///   f = argmin of the integral of |grad f - m / l|^2 over where w > 0, plus a slow random jitter
///
/// Lines are perpendicular to the fibres, evenly spaced where fibres are parallel, fanned where they turn about eye or mouth. For a crease
/// that is always one line (nasolabial), f is the distance from its curve. Everything is fixed in the rest shape, so lines move with the
/// skin and do not flicker. Patterns that overlap have different slots. The patterns are a table of the rig (rig/wrinkle_table.h).
///
/// Lines of expression lie across the pull of the muscles: Kraissl 1951, Plast. Reconstr. Surg. 8(1), 1-28.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// Number of patterns that can overlap; the number of columns of the tables below.
inline constexpr int kWrinkleSlots = 3;

/// A line that folds as a whole.
struct Crease {
    int slot = 0;
    std::vector<int> vertex;      ///< vertices where its window is above 0
    std::vector<double> place_m;  ///< position of each along the line, m
};

struct WrinkleLines {
    Points phase;       ///< V x 3, f
    Points window;      ///< V x 3, w times the fraction of its depth that a fold gets here, 0..1
    Points wavelength;  ///< V x 3, l, m
    std::vector<Crease> creases = {};
    Points at_rest =
        {};  ///< V x 3 or no rows, 0..1: permanence, how much of the lines stays in old skin at rest
};

/// `skin`: the part of the head's skin that moves, over mesh vertices.
WrinkleLines lay_wrinkle_lines(const rig::Head& head, const rig::RigDescription& rig,
                               const Triangles& skin);

}  // namespace risorius::face
