// SPDX-License-Identifier: MIT
/// \file
/// Texture coordinates of parts made of rings: eyes, tooth crowns and the tongue as discs about their pole, without a visible seam; gums as
/// strips. Each kind of part has a square that left and right, upper and lower parts share.
#pragma once

#include <array>

#include "risorius/core/types.h"

namespace risorius::headmodel {

/// A part laid out as a disc about one of its poles.
struct Disc {
    Vec2 middle{0.5, 0.5};
    double radius = 0.49;
    double turn = 1;  ///< -1 where angles run clockwise, seen from outside

    /// Returns a position in the square. `fraction`: how far it is from the pole in the middle (0) to the other end (1). `angle`:
    /// about the pole, rad.
    Vec2 at(double fraction, double angle) const;
};

/// The layout of an eye, with the front pole in the middle. Both eyes have the same layout, so one picture serves both.
Disc eye_disc(double side);
/// The layout of a tooth crown, with its edge in the middle. Crowns 0..13 of an arch are the left ones from the front backwards,
/// then the right ones. The upper arch lies above the lower one.
Disc crown_disc(bool upper, int crown);
/// The layout of the tongue: the tip is in the middle, and the back of the tongue lies above it.
Disc tongue_disc();

/// Returns a position on the strip of the gums. `along`: from the right end to the left, 0..1. `around`: from the root over the
/// side of the lips, 0..1.
Vec2 gum_place(bool upper, double along, double around);

}  // namespace risorius::headmodel
