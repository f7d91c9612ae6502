// SPDX-License-Identifier: MIT
/// \file
/// Texture coordinates of parts made of rings: eyes, tooth crowns and the tongue as discs about their pole, without a visible seam; gums and
/// lashes as strips. Each kind of part has a square that left and right, upper and lower parts share.
#pragma once

#include <array>

#include "risorius/core/types.h"

namespace risorius::headmodel {

/// A part laid out as a disc about one of its poles.
struct Disc {
    Vec2 middle{0.5, 0.5};
    double radius = 0.49;
    double turn = 1;  ///< -1 where angles run clockwise, seen from outside

    /// `share`: fraction of the way from the pole in the middle to the other end.
    Vec2 at(double fraction, double angle) const;
};

/// Both eyes at the same place: one picture for both. The front pole is in the middle.
Disc eye_disc(double side);
/// Crown 0..13 of an arch, edge in the middle: the left ones from the front backwards, then the right ones; the upper arch above.
Disc crown_disc(bool upper, int crown);
/// Tip in the middle, the back of the tongue above it.
Disc tongue_disc();

/// Place on the gums' strip: `along` from the right end to the left, `around` from the root over the side of the lips, 0..1 both.
Vec2 gum_place(bool upper, double along, double around);

/// Place on a ribbon of lashes: `along` the lid from where it begins, `out` from the roots to the tips, 0..1 both.
Vec2 lash_place(bool upper, double along, double out);

}  // namespace risorius::headmodel
