// SPDX-License-Identifier: MIT
/// \file
/// Reads the action units of a face as a coder of FACS measures them: how far the landmarks of a unit move, compared with the targets of
/// facs.json, how evenly they move with the intensity, and what happens to the eye opening, the mouth and the furrows of the skin.
///
/// Every pose is an equilibrium of the left and the right unit together. A unit that is seen with others only (ActionUnit::seen_with) is
/// added to them, and read from their pose. The targets are those of the average head. They are scaled to
/// the head region by region: eyes and brows by the width of the eye fissure, mouth by the width of the mouth, everything else by the
/// height of the face from nasion to chin.
///
///   gain      sum over landmarks of moved . target / sum of target . target: 1 when the unit moves as far as it should
///   response  the fraction of its own full way, measured in the same direction, at intensity 0.25, 0.5 and 0.75
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/face.h"
#include "risorius/rig/rig_description.h"
#include "risorius/scene/detail/skin_readings.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/track/channels.h"
#include "risorius/track/facs.h"

namespace risorius::scene {

/// A landmark of a unit, on the left side or the midline.
struct LandmarkReading {
    std::string landmark;
    Vec3 target_mm, moved_mm;  ///< on this head
    double gain = 0;           ///< along the target
};

/// What coders look at besides landmarks; left eye and left nasolabial fold. Lengths in mm.
struct FaceMeasures {
    double lid_aperture = 0;       ///< between the middles of the lid margins
    double mouth_width = 0;        ///< between the corners
    double lip_gap = 0;            ///< between the lips in the middle; 0 or less: closed
    double corner_height = 0;      ///< mean of both corners, above that of the neutral face
    double nasolabial_furrow = 0;  ///< depths, see detail/skin_readings.h
    double glabellar_furrow = 0;
    double forehead_furrow = 0;
    double lip_contact_mm2 = 0;

    FaceMeasures operator-(const FaceMeasures& other) const;
};

/// What goes wrong in the tissue in a pose. Depths and volume are changes from rest.
struct TissueFaults {
    int inverted_tets = 0;     ///< that are turned inside out
    double volume_change = 0;  ///< of all tissue, a ratio
    double lip_depth_mm = 0;   ///< of one lip in the other, at nodes
    double eye_depth_mm = 0;   ///< of the skin in the eyes, at vertices
    double bone_depth_mm = 0;  ///< of tissue in bone and teeth, at nodes
};

struct UnitReading {
    std::string unit;  ///< "AU12"
    std::string name;  ///< "Lip corner puller"
    std::vector<LandmarkReading> landmarks;
    double gain = 0;
    std::vector<double> response;  ///< three, or none where they were not asked for
    FaceMeasures change;  ///< at intensity 1, from the neutral face or the units it is seen with
    double uneven_mm =
        0;  ///< largest difference of a landmark from the mirror image of its partner, or of a middle one from the middle
    bool in_equilibrium = true;
    TissueFaults faults;  ///< at intensity 1
    face::FacePose pose;  ///< the same
};

/// Reads the units of one face. The face is left in the last pose.
class UnitReader {
  public:
    /// Both must outlive this object. `tolerance_m`: of the equilibria, see StaticOptions.
    UnitReader(face::Face& face, const rig::RigDescription& rig,
               double tolerance_m = face::StaticOptions{}.tolerance_m);

    const Points& neutral() const { return neutral_.vertices; }  ///< V x 3, m
    const face::FacePose& neutral_pose() const { return neutral_; }
    FaceMeasures measures(const face::FacePose& pose) const;
    /// Reads the unit at full intensity and, with `steps`, at a quarter, a half and three quarters. It needs landmark targets.
    UnitReading read(const track::ActionUnit& unit, bool steps = true);
    /// Returns the gain of `sum` along the targets of `unit`.
    double gain(const track::ActionUnit& unit, const track::Expansion& sum);

  private:
    struct Pose {
        face::FacePose pose;
        bool in_equilibrium;
        TissueFaults faults;
    };
    Pose pose(const track::Expansion& sum);
    track::Expansion others(const track::ActionUnit& unit) const;
    const face::FacePose& base(const track::ActionUnit& unit);
    std::vector<LandmarkReading> targets(const track::ActionUnit& unit) const;
    Vec3 moved_mm(const std::string& landmark, const Points& from, const Points& to) const;
    double uneven_mm(const UnitReading& reading, const Points& from) const;
    std::string side_of(const std::string& landmark) const;
    const rig::AtlasLandmark& atlas(const std::string& id) const;
    double ratio(const char* a, const char* b) const;
    double scale(const std::string& landmark) const;

    face::Face& face_;
    const rig::RigDescription& rig_;
    double tolerance_m_;
    LandmarkPoints points_;
    SkinReader skin_;
    track::ChannelTable channels_;
    track::Drive rest_;
    face::FacePose neutral_;
    double volume_m3_ = 0;  ///< of the tissue of the neutral face
    std::map<std::string, face::FacePose>
        base_;  ///< of the units that a unit is seen with, by its id
};

}  // namespace risorius::scene
