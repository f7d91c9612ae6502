// SPDX-License-Identifier: MIT
/// \file
/// The head as other programs get it: a hierarchy of nodes with the names they know, parts with materials and pictures, and joints
/// that turn head and neck.
///
///   NAME            the name of the rig
///     Shoulders, Neck, Head   joints; Neck has half of the head's turn
///       LeftEye, RightEye     below Head, at the centres of the eyes; EyeLeft and EyeRight are the eyeballs
///       TeethUpper, TeethLower, Tongue, Lashes   below Head
///   Face            skin and wall of the mouth, carried by the joints; nothing else moves it, so it is a root of its own
///
/// Joints blend linearly, which shortens the neck by 2 % at 45 degrees.
#pragma once

#include <string>
#include <vector>

#include "risorius/face/face.h"
#include "risorius/io/morph_model.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/motion.h"

namespace risorius::blendshapes {

/// What turns the eyeballs: morph targets, the pivots LeftEye and RightEye, or both, of which animations use the pivots alone.
enum class EyesBy { kMorph, kBone, kBoth };
EyesBy eyes_named(const std::string& name);  ///< "morph", "bone", "both"; throws Error

/// Returns the model without shapes. Each part has the pictures of the mesh where it has some, else one of the look with
/// `texture_px` pixels along its side (half of that for all but the skin), else, with 0 or without texture coordinates, a colour.
io::MorphModel morph_head(const scene::RigFiles& files, const face::Face& face, int texture_px,
                          EyesBy eyes);

/// Describes the turn of the lower teeth by the shape jawOpen in the extras of the node TeethLower, for programs that turn them
/// with a joint instead: "jaw" has the shape, a pivot on the axis (m, at rest), the axis, and the angle and the slide along the
/// axis at weight 1. Call it when the model has its targets; without that shape it does nothing.
void describe_jaw(io::MorphModel& model);

/// Returns the turns of head, neck and, unless morph targets turn them, eyes of such a model, one per drive; only of those that turn at
/// all.
std::vector<io::NodeMotion> node_motions(const io::MorphModel& model, const face::Face& face,
                                         const std::vector<track::Drive>& drives);

}  // namespace risorius::blendshapes
