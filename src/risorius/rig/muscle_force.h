// SPDX-License-Identifier: MIT
/// \file
/// The maximum isometric force of a muscle on a head. The simulation places its muscles with these functions, and `risorius info` prints
/// what they return.
///
///   F0 = F_table s f k^2
///   F_table   force in the table, N, for the average adult   s   strength of this rig     f   common factor of the group
///   k         size of the head over the average adult: forces follow areas
#pragma once

#include <string_view>

#include "risorius/rig/rig_description.h"

namespace risorius::rig {

/// Factor on the forces of the table for muscles of jaw and hyoid, which assume a stress of 40 N/cm2 in all muscles. With this factor
/// the incisors bite with 300 N (the jaw alone, on a block of 15 mm) to 390 N (in the face, 10 mm); with the table alone it would be half as
/// much again. Measured values are 150 to 400 N.
inline constexpr double kJawForceFraction = 0.67;

/// How a muscle is simulated.
enum class MuscleModel {
    kNone,     ///< no force: the muscle only moves a lid, or has neither bands nor paths
    kBundles,  ///< bundles of fibres in the tissue
    kSolid,    ///< a volume muscle
    kLine,     ///< a line of action between bones, which pulls only when muscles move the jaw
};
std::string_view name_of(MuscleModel model);  ///< "none", "bundles", "solid", "line"

/// The force of one side of a muscle, or of the whole muscle when it has only one column.
struct MuscleForce {
    MuscleModel model = MuscleModel::kNone;
    double table_n = 0;     ///< F_table
    double strength = 1;    ///< s
    double factor = 1;      ///< f
    double greatest_n = 0;  ///< F0, all fibres together
};

/// `size` is k, Head::size.
MuscleForce muscle_force(const RigDescription& rig, const Muscle& muscle, double size);

/// Returns F0 of one fibre, N, of a band whose muscle has `fibres` times as many as itself: bands share the force of their muscle equally,
/// and fibres that of their band.
double fibre_force_n(const RigDescription& rig, const MuscleBand& band, double size, int fibres);

/// Returns F0 of a volume muscle, N.
double solid_force_n(const RigDescription& rig, const SolidMuscle& solid, const Muscle& muscle,
                     double size);

/// Returns F0 of the line of action of a muscle of jaw or hyoid, N.
double line_force_n(const Muscle& muscle, double size);

/// Returns the number of bands of a muscle on one side.
int bands_of(const Atlas& atlas, const std::string& muscle);

}  // namespace risorius::rig
