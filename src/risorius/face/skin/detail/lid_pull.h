// SPDX-License-Identifier: MIT
/// \file
/// How far a lowered brow and a raised cheek take the eyelids along. Skin, orbicularis and fat over the orbit are one sheet: the brow
/// pushes the fold of the upper lid down, and the cheek pushes the lower lid up.
///
///   upper = a s(mean over bm, bc, bp of how far each is below rest)      lower = b s(how far ma is above rest)
///
///   a, b   mm of lid per mm of brow or cheek: EyesDescription::upper_lid_per_brow, lower_lid_per_cheek
///   s(d)   d^2 / (d + s0) for d > 0, else 0: d, rounded off at the start, so that its derivative is continuous; s0 = 0.5 mm
///
/// A raised brow and a lowered cheek do not move the margins: the levator holds the upper lid, the tarsal plate the lower one.
#pragma once

#include <array>

#include "risorius/core/types.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::face {

/// What brow and cheek do to the lids of one eye, m.
struct LidPull {
    double upper_m = 0.0;  ///< the upper margin comes down
    double lower_m = 0.0;  ///< the lower margin goes up
};

/// Measures the pull on the lids of both eyes from the skin.
class LidPullMeasure {
  public:
    LidPullMeasure(const rig::Head& head, const rig::EyesDescription& eyes);

    /// `skin`: V x 3, m, the vertices of the mesh as the tissue moves them, head frame. Returns left and right.
    std::array<LidPull, 2> of(const Points& skin) const;
    /// Adds to `by_skin` (V x 3) the gradient of a function of the pull; `slope` is its gradient by the pull of each eye, 1/m.
    void add_gradient(const Points& skin, const std::array<LidPull, 2>& slope,
                      Points& by_skin) const;

  private:
    struct Place {
        int vertex;
        double rest_y_m;
    };
    double brow_m(int side, const Points& skin) const;   ///< mean, positive below rest
    double cheek_m(int side, const Points& skin) const;  ///< positive above rest

    std::array<std::array<Place, 3>, 2> brow_;
    std::array<Place, 2> cheek_;
    double upper_per_brow_, lower_per_cheek_;
    double start_m_;  // s0
};

}  // namespace risorius::face
