// What brings about an expression that is known by name: an ARKit shape, an action unit or an expression of a rig's tables, or
// one muscle at full excitation.
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

/// Nothing when the rig's tables do not know the name. A side of what the tables only have whole is that side's muscles
/// and half of what has no sides.
std::optional<track::Expansion> expansion_named(const rig::RigDescription& rig,
                                                const std::string& name);

/// Within the range of every muscle and channel.
track::Drive clamped_drive(const track::Expansion& sum, const track::ChannelTable& channels);

/// What of it is not zero, by the names of columns and channels.
Json drive_json(const track::Drive& drive, const track::ChannelTable& channels);

}  // namespace risorius::rig
