// Where skin folds and which way: the usual lines of expression of a face, laid across the muscles that draw them.
//
//   f   phase over the rest surface, valleys at whole numbers        m   direction of the fibres, unit
//   l   distance of the lines (wavelength)            w   window: 1 where the lines belong, 0 elsewhere
//
//   f = argmin of the integral of |grad f - m / l|^2 over where w > 0, plus a slow random waver
//
// so that lines lie across the fibres, evenly where these run parallel, fanned where they turn about eye or mouth. A
// crease that is always one line (nasolabial) has the distance from its curve for a phase. All of it is fixed in the rest shape:
// lines ride on the skin and neither swim nor flicker. Patterns that overlap are in different slots.
//
// Lines of expression lie across the pull of the muscles: Kraissl 1951, Plast. Reconstr. Surg. 8(1), 1-28.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// Patterns at one place, the columns of the tables below.
inline constexpr int kWrinkleSlots = 3;

/// A line that folds as a whole.
struct Crease {
    int slot = 0;
    std::vector<int> vertex;      ///< where its window is open
    std::vector<double> place_m;  ///< of each, along the line
};

struct WrinkleLines {
    Points phase;       ///< V x 3, f
    Points window;      ///< V x 3, w times the share of its depth that a fold gets here, 0..1
    Points wavelength;  ///< V x 3, l, m
    std::vector<Crease> creases = {};
    Points at_rest =
        {};  ///< V x 3 or none, 0..1: how far lines stay in skin that has folded for a lifetime
};

/// `skin` is the part of the head's skin that moves, over mesh vertices.
WrinkleLines lay_wrinkle_lines(const rig::Head& head, const rig::RigDescription& rig,
                               const Triangles& skin);

}  // namespace risorius::face
