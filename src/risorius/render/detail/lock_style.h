// SPDX-License-Identifier: MIT
/// \file
/// The styles of hair as numbers: how many locks, how long, and where they go.
#pragma once

#include <string>

#include "risorius/core/types.h"

namespace risorius::render {

/// The way a lock takes over the scalp.
enum class HairFlow {
    kWhorl,    ///< away from the whorl behind the crown
    kParting,  ///< away from a parting, and down
    kRadial,   ///< out from the head, in tufts of any direction
    kKnot,     ///< to a knot at the back of the head
    kDown,
};

/// Lengths in mm. A lock is a strip that lies on a hull over the scalp.
struct LockStyle {
    const char* name;
    int locks = 0;     ///< on the scalp
    int segments = 4;  ///< of a lock
    int across = 3;    ///< points across a lock: 2, or 3 with the section of a roof
    double top_mm = 0, side_mm = 0, back_mm = 0;
    HairFlow flow = HairFlow::kWhorl;
    double lift = 0;       ///< from the skin at the root: slope
    double fall = 0;       ///< how much weight bends it down
    double width_mm = 10;  ///< of a lock
    double cap_mm = 2;     ///< thickness of the cap under the locks
    double layers_mm = 2;  ///< the outermost lock lies this far above the innermost
    double loft_mm = 2;    ///< how far a lock may stand off its layer
    double sunk_mm =
        0;  ///< how deep the sides of a lock lie in the cap, so that only its ridge is seen
    double fray_mm = 0;   ///< length of the pointed strands in which a lock ends; 0: it ends in one
    double tip = 0.08;    ///< width of the tip, as a share
    double curl_mm = 0;   ///< radius
    double pitch_mm = 1;  ///< of the curl, or of the wave
    double parting_mm = 0;   ///< x of the parting
    double lit_cap = 0.5;    ///< light that the cap gets, as a share
    bool over_ears = false;  ///< locks lie over the ears; otherwise they end above them
    bool ring = false;       ///< the crown is bald
    bool hangs = false;      ///< down to `cut_mm` above the jaw, whatever the length
    double fringe = 0;       ///< 0..1, how far the locks of the front come down to the brows
    double cut_mm = 0;       ///< height of the tips above those at the jaw
    bool tail = false;       ///< from the knot
};

/// Returns the style of a name, or null for "shaven". The name must be one of hair_style_names().
const LockStyle* lock_style(const std::string& name);

/// What a person changes of a style.
struct LockChange {
    double length = 1;   ///< factor of its lengths
    double wave = 0;     ///< 0..1, waves beside its own; of styles with a parting
    double parting = 1;  ///< factor of the place of its parting
    double fringe = 0;   ///< as LockStyle::fringe; of styles with a parting
};
/// Returns the style as changed.
LockStyle varied_style(LockStyle style, const LockChange& change);

/// How a form of the hairline differs from the one that the landmarks give, mm.
struct HairlineForm {
    const char* name;
    double higher_mm = 0;   ///< all of the front
    double middle_mm = 0;   ///< the middle of the front, further up
    double bay_mm = 0;      ///< the bays beside it, further up
    double temples_mm = 0;  ///< bays and temples, further back
};
const HairlineForm& hairline_form(const std::string& name);

}  // namespace risorius::render
