// SPDX-License-Identifier: MIT
/// \file
/// The blend shapes of a set: their names, their drives and their relations.
///
///   arkit52   the 52 names of ARKit face tracking, by the rig's own table
///   facs      every action unit of the rig's table that moves the face, .l and .r where it has sides
///   muscles   each muscle alone at full activation, and the channels that no muscle drives
///   visemes   the mouth shapes of speech, by the rig's own table
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/rig/rig_description.h"
#include "risorius/track/channels.h"

namespace risorius::blendshapes {

/// Relation of a shape to its namesake on the other side.
enum class Sides {
    kNone,    ///< no namesake
    kHalves,  ///< both together form one expression, such as a smile
    /// Mirror images that are not meant to be used together, such as the jaw to one side
    kOpposed,
};

/// A shape to make.
struct ShapeGoal {
    std::string name;
    track::Drive drive;  ///< at weight 1
    Sides sides = Sides::kNone;
    int partner = -1;   ///< index of the namesake; -1: none
    bool left = false;  ///< whether this shape is the one on the left side
    /// Index of the shape that this one corrects; it is used at the same weight; -1: none
    int on_top_of = -1;
    /// Name of both halves together, such as "mouthSmile"; the shape's own name if it has no halves
    std::string whole;
};

struct ShapeSet {
    std::string name;
    std::vector<ShapeGoal> goals;
    /// Entries of the table that cannot be made into shapes: name and reason.
    std::vector<std::pair<std::string, std::string>> left_out;

    std::optional<int> index(const std::string& name) const;
};

const std::vector<std::string>& shape_set_names();

/// Makes the goals of a set. `only`: the names of the shapes to make, or of wholes (ShapeGoal::whole); empty: all. Throws Error
/// for a set that is unknown or missing in the tables of the rig; the message names `place`. Throws Error for a name in `only`
/// that the set does not have; the message names `only_from`, the source of `only`.
ShapeSet shape_set(const rig::RigDescription& rig, const std::string& set,
                   const std::vector<std::string>& only, const std::string& place,
                   const std::string& only_from = option_name("only"));

}  // namespace risorius::blendshapes
