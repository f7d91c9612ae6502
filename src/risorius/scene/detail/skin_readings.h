// SPDX-License-Identifier: MIT
/// \file
/// What a coder of FACS sees in the skin besides where it goes: how deep it folds, and how much of the lips touches.
///
///   depth     of a furrow: that of the profile of the skin across it below its own convex hull, plus the depth of the deepest wrinkle
///             there that is finer than the mesh
///   contact   area of the skin of the upper lip that lies within 0.5 mm of the lower lip
///
/// The profiles are lines of skin that are fixed at rest and move with it: three across the left nasolabial fold, between the upper lip
/// and the cheek; one from brow to brow; one from the left brow up the forehead.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/face.h"
#include "risorius/geom/closest_point.h"

namespace risorius::scene {

/// A place where faces fold.
enum class Furrow { kNasolabial, kGlabellar, kForehead };
inline constexpr std::array<Furrow, 3> kFurrows{Furrow::kNasolabial, Furrow::kGlabellar,
                                                Furrow::kForehead};

/// Returns how deep a profile goes below its convex hull, m. `outward`: the side of the air; the profile runs from its first to its last
/// point, and may fold back.
double depth_below_hull(const std::vector<Vec3>& profile, const Vec3& outward);

class SkinReader {
  public:
    /// `face` must outlive this object. Wrinkles count by their patterns: "frown" between the brows, "forehead" above them, all beside the
    /// nose.
    SkinReader(face::Face& face, const rig::RigDescription& rig);

    double furrow_mm(Furrow furrow, const face::FacePose& pose) const;
    double lip_contact_mm2(const face::FacePose& pose) const;

  private:
    struct Profile {
        std::vector<geom::SurfaceBinding> points;
        Vec3 outward;
    };
    struct Place {
        std::vector<Profile> profiles;
        std::vector<int> wrinkled;                    ///< vertices
        std::array<bool, 3> slots{true, true, true};  ///< of FacePose::fold_depth that count
    };
    Profile profile(const Vec3& from, const Vec3& to) const;
    void place_furrows();
    void place_lips();

    face::Face& face_;
    Triangles skin_;
    geom::SurfaceTree rest_;
    std::array<Place, 3> places_;
    std::vector<int> upper_lip_;  ///< vertices
    Triangles lower_lip_;
};

}  // namespace risorius::scene
