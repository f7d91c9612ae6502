// SPDX-License-Identifier: MIT
/// \file
/// Where the skin folds and in which direction: the usual lines of expression of a face. They lie across the muscles that fold the skin.
///
///   f   phase over the rest surface, valleys at whole numbers        m   direction of the fibres, unit
///   l   distance between lines (wavelength), m        w   window: 1 where the lines belong, 0 elsewhere
///
///   f = argmin of the integral of |grad f - m / l|^2 over where w > 0, plus a slow random jitter
///
/// Lines are perpendicular to the fibres. They are evenly spaced where fibres are parallel, and form a fan where fibres turn about eye or
/// mouth. For a crease that is a single line (nasolabial), f is the signed distance from the curve of the crease / l.
///
/// Everything is fixed in the rest shape, so lines move with the skin and do not flicker. Patterns that overlap have different slots;
/// where two of a slot meet, both fade. The patterns are a table of the rig (rig/wrinkle_table.h).
///
/// Lines of expression lie across the pull of the muscles: Kraissl 1951, Plast. Reconstr. Surg. 8(1), 1-28.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// Number of slots: of patterns that can overlap, and of columns in the tables below.
inline constexpr int kWrinkleSlots = 3;

/// A single line that folds as a whole along its length.
struct Crease {
    int slot = 0;
    std::vector<int> vertex;      ///< vertices where its window is above 0
    std::vector<double> place_m;  ///< position of each along the line, m
};

/// The lines of one head. V: vertices of the mesh; each table has one column per slot.
struct WrinkleLines {
    Points phase;   ///< V x 3, f
    Points window;  ///< V x 3, w times the fraction of its full depth that a fold has here, 0..1
    Points wavelength;  ///< V x 3, l, m
    std::vector<Crease> creases = {};
    /// V x 3 or no rows, 0..1: permanence, how deep the lines of old skin remain at rest.
    Points at_rest = {};
    /// V x 3 or no rows: how much more the skin must shorten before it folds than skin does elsewhere, ratio.
    Points later = {};
    /// V x 3 or no rows: whose a phase is. A phase that others change beside a line would bend it.
    enum Claim : signed char { kFree, kBesideLine, kOfLine };
    Eigen::Array<signed char, Eigen::Dynamic, kWrinkleSlots> claim = {};
};

/// Returns the lines of a head. `skin`: triangles of the part of its skin that moves, indices of mesh vertices.
WrinkleLines lay_wrinkle_lines(const rig::Head& head, const rig::RigDescription& rig,
                               const Triangles& skin);

}  // namespace risorius::face
