// SPDX-License-Identifier: MIT
#include "risorius/rig/muscle_force.h"

#include <algorithm>

namespace risorius::rig {

namespace {

// Tissue holds mimetic muscles back, and their forces are scaled for it. Jaw muscles have the forces of their lines of action.
double factor_of(const RigDescription& rig, const Muscle& muscle) {
    return muscle.group == "mimetic" ? rig.tissue.force_scale : kJawForceFraction;
}

}  // namespace

std::string_view name_of(MuscleModel model) {
    switch (model) {
        case MuscleModel::kBundles:
            return "bundles";
        case MuscleModel::kSolid:
            return "solid";
        case MuscleModel::kLine:
            return "line";
        case MuscleModel::kNone:
            break;
    }
    return "none";
}

int bands_of(const Atlas& atlas, const std::string& muscle) {
    return static_cast<int>(
        std::count_if(atlas.bands.begin(), atlas.bands.end(),
                      [&](const MuscleBand& band) { return band.muscle == muscle; }));
}

double fibre_force_n(const RigDescription& rig, const MuscleBand& band, double size, int fibres) {
    return band.force_n * band.strength * rig.tissue.force_scale * size * size / fibres;
}

double solid_force_n(const RigDescription& rig, const SolidMuscle& solid, const Muscle& muscle,
                     double size) {
    return muscle.force_n * solid.strength * factor_of(rig, muscle) * size * size;
}

double line_force_n(const Muscle& muscle, double size) {
    return kJawForceFraction * muscle.force_n * size * size;
}

MuscleForce muscle_force(const RigDescription& rig, const Muscle& muscle, double size) {
    MuscleForce out;
    out.table_n = muscle.force_n;
    if (const SolidMuscle* solid = rig.solid(muscle.id)) {
        out.model = MuscleModel::kSolid;
        out.strength = solid->strength;
        out.factor = factor_of(rig, muscle);
        out.greatest_n = solid_force_n(rig, *solid, muscle, size);
        return out;
    }
    if (const int bands = bands_of(rig.atlas, muscle.id); bands > 0) {
        out.model = MuscleModel::kBundles;
        out.factor = rig.tissue.force_scale;
        out.table_n = 0;
        for (const MuscleBand& band : rig.atlas.bands) {
            if (band.muscle != muscle.id) continue;
            out.table_n += band.force_n / bands;
            out.strength = band.strength;
            // A muscle with one column has both sides of a band that does not cross the midline
            const int sides = muscle.paired || band.crosses_midline() ? 1 : 2;
            out.greatest_n += sides * fibre_force_n(rig, band, size, bands);
        }
        return out;
    }
    if ((muscle.group == "jaw" || muscle.group == "hyoid") && !muscle.paths.empty()) {
        out.model = MuscleModel::kLine;
        out.factor = kJawForceFraction;
        out.greatest_n = line_force_n(muscle, size);
    }
    return out;
}

}  // namespace risorius::rig
