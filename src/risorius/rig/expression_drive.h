// SPDX-License-Identifier: MIT
/// \file
/// The drive that produces an expression known by name: an ARKit shape, an action unit, an expression of the rig's tables, or one muscle
/// at full excitation.
#pragma once

#include <optional>
#include <string>

#include "risorius/core/json_cursor.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"
#include "risorius/track/facs.h"

namespace risorius::rig {

/// "mouthSmile_L" and "mouthSmileLeft" are the left side of "mouthSmile"; other names have no side.
struct SidedShape {
    std::string base;
    std::optional<Side> side;
};
SidedShape split_shape(const std::string& name);

/// Empty when the rig's tables do not know the name. For one side of an expression that the tables give only as a whole, the muscles of
/// that side are used, and half of everything that has no side.
std::optional<track::Expansion> expansion_named(const rig::RigDescription& rig,
                                                const std::string& name);

/// The drive with every muscle and channel clamped to its range.
track::Drive clamped_drive(const track::Expansion& sum, const track::ChannelTable& channels);

/// The values of the drive that are not zero, by the names of columns and channels.
Json drive_json(const track::Drive& drive, const track::ChannelTable& channels);

}  // namespace risorius::rig
