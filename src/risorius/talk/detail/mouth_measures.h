// SPDX-License-Identifier: MIT
/// \file
/// Measures of a mouth on the mesh of a head: how far the lips are apart, how wide and how far forward they are.
///
/// The gap is the least distance between upper and lower lip in a sagittal section (a plane with one x), so it is 0 where they
/// touch. A distance between two landmarks does not tell that, because landmarks move along rolling lips.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "risorius/face/face.h"
#include "risorius/rig/head.h"
#include "risorius/scene/landmark_points.h"

namespace risorius::talk {

/// All in mm; width and protrusion are changes from rest.
struct Mouth {
    double gap_middle = 0;  ///< largest gap of the sections within 3 mm of the middle
    double gap_side = 0;    ///< largest gap of the sections at 9 mm beside it
    double gap = 0;         ///< the larger of both: 0 in a closure
    double width = 0;       ///< between the corners of the mouth
    /// Forwards; that of the lower lip from where the mandible has carried it
    double upper_protrusion = 0, lower_protrusion = 0;
    double jaw = 0;       ///< opening at the incisors
    double teeth = 0;     ///< lower lip to the edge of the upper incisors; 0 in heads without teeth
    double area_mm2 = 0;  ///< of the opening between the sections at 12 mm on both sides
    double contact_mm = 0;  ///< length of contact among these sections
};

class MouthMeasures {
  public:
    /// The head must have the landmarks ls, li, ch_l and ch_r.
    MouthMeasures(const rig::Head& head, const rig::RigDescription& rig);

    Mouth at(const face::FacePose& pose) const;

  private:
    scene::LandmarkPoints landmarks_;
    Triangles upper_, lower_;     ///< of the lips
    std::vector<Vec3> incisors_;  ///< edge of the upper incisors, head frame, m
    double middle_x_ = 0;
    double millimetre_;  ///< of the atlas head on this head, m
    Vec3 rest_lower_;    ///< landmark li at rest, m
    double rest_width_, rest_upper_, rest_gap_ = 0;
};

}  // namespace risorius::talk
