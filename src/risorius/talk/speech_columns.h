// SPDX-License-Identifier: MIT
/// \file
/// Columns of a table of frames for scripts with speech: what is said at the time of a frame, and what the mouth does.
///
///   phone, word, viseme      of the sound at this time; a pause is "_"
///   lip_gap_mm               largest free height between the lips in the sections at 0, 3 and 9 mm from the middle; 0: contact
///   lip_width_change_mm      corner to corner, from rest
///   lip_area_mm2             opening between the sections at 12 mm
///   lip_protrusion_upper_mm, lip_protrusion_lower_mm     from rest; of the lower lip from where the mandible carries it
///   lip_contact_mm           length of contact between the sections at 12 mm
///   lip_teeth_mm             lower lip to the edge of the upper incisors
#pragma once

#include <string>
#include <vector>

#include "risorius/talk/detail/mouth_measures.h"
#include "risorius/talk/say_event.h"

namespace risorius::talk {

class SpeechColumns {
  public:
    SpeechColumns(std::vector<PlacedUtterance> utterances, const rig::Head& head,
                  const rig::RigDescription& rig);

    /// "\tphone\tword ..."
    static std::string names();
    std::string cells(double t_s, const face::FacePose& pose) const;

  private:
    std::vector<PlacedUtterance> utterances_;
    speech::PhoneTable table_;
    MouthMeasures measures_;
};

}  // namespace risorius::talk
