// The bones of the head as fields of distance in the standard head: what they are where the skin says nothing of them.
//
// Frame: the head frame of the standard head, mm (rigs/standard/landmarks.json). Symmetric.
#pragma once

#include "risorius/core/types.h"

namespace risorius::face {

/// Of one bone; negative inside. Its outer side is where the tissue over it is as thick as measured, so `outer` reaches beyond.
struct BoneFields {
    double vault;   ///< the braincase; like the next to be cut off by the tissue's thickness
    double temple;  ///< hollow of the temples in it, positive outside of that
    double outer;   ///< all else that lies under the skin
    double carved;  ///< what is hollow: orbits, nose, ear canals; positive outside of the hollows
    double inner;   ///< what the skin over it does not bound: tooth sockets, partition of the nose
};

BoneFields skull_fields(const Vec3& p_mm);
BoneFields mandible_fields(const Vec3& p_mm);

/// Of the thin roof of the nose, by depth under the tissue: none elsewhere.
bool near_nasal_bone(const Vec3& p_mm);
double nasal_bone_field(const Vec3& p_mm, double depth_under_tissue_mm);

/// The smooth union, and intersection, of two: like min and max, rounded within `round`.
double smooth_union(double a, double b, double round);
double smooth_cut(double a, double b, double round);

}  // namespace risorius::face
