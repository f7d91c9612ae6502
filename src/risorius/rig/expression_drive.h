// SPDX-License-Identifier: MIT
/// \file
/// The drive of a named expression: an ARKit shape, an action unit, an expression of the rig's tables, or a single muscle, at full
/// or any intensity.
#pragma once

#include <optional>
#include <string>

#include "risorius/core/json_cursor.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"
#include "risorius/track/facs.h"

namespace risorius::rig {

/// A name split into base and side: "mouthSmile_L" and "mouthSmileLeft" are the left side of "mouthSmile". Other names have no
/// side.
struct SidedShape {
    std::string base;
    std::optional<Side> side;
};
SidedShape split_shape(const std::string& name);

/// Returns what an action unit, expression, ARKit shape, muscle or kinematic channel adds to the drive at an intensity, as in a script: units
/// follow their curves, so that half of the intensity shows half of the motion, which may take a fifth of the excitation. If the tables have a
/// shape only as a whole, one side of it has the muscles of that side, and half of everything without a side. Returns nothing when the rig does
/// not have the name, or has it without the side.
std::optional<track::Expansion> expansion_at(const rig::RigDescription& rig,
                                             const std::string& name, double intensity);

/// Returns the drive of an expansion, with every muscle and channel clamped to its range.
track::Drive clamped_drive(const track::Expansion& sum, const track::ChannelTable& channels);

/// Returns the non-zero values of the drive, with the names of columns and channels as keys.
Json drive_json(const track::Drive& drive, const track::ChannelTable& channels);

}  // namespace risorius::rig
