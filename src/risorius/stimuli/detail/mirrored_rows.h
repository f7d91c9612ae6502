// SPDX-License-Identifier: MIT
/// \file
/// The table of frames of a clip whose pictures are mirrored: left and right are exchanged in it, too.
#pragma once

#include <string>

#include "risorius/animate/frame_rows.h"

namespace risorius::stimuli {

/// Returns the name of a column, a landmark or an action unit on the other side: "ch_l.u_px" -> "ch_r.u_px", "AU12.l" -> "AU12.r",
/// "AU51" -> "AU52". A name without a side is returned as it is.
std::string other_side(const std::string& name);

/// Returns the table as it is for the mirrored face: each column has the values of the other side, and what points to a side has the
/// other sign. `width_px`: of the pictures.
animate::FrameRows mirrored(const animate::FrameRows& rows, int width_px);

}  // namespace risorius::stimuli
