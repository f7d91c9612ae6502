// SPDX-License-Identifier: MIT
/// \file
/// A single muscle: a belly as a grid solid, with its musculotendon, between two plates. It serves for the experiments of Zajac
/// and of Gasser and Hill, and for tests of the stability of integration methods.
///
///   {"discretisation": "cells", "grid": [6, 6, 6], "section": "round", "length_m": 0.04, "width_m": 0.02,
///    "thickness_m": 0.02,
///    "moduli": {"shear_pa": 2000, "bulk_pa": 5e6, "viscosity_pa_s": 200, "density_kg_per_m3": 1060},
///    "musculotendon": {"f0_n": 94.2, "optimal_length_m": 0.04, "tendon_slack_m": 0.02}}
///
/// The belly extends along x from x = 0, and its axis goes through the origin. Each plate is half the tendon slack length away
/// from an end. A shape of muscle/muscle_shape.h may replace "section" and the three sizes. Points of a bone, or nothing, may
/// replace a plate:
///
///    "shape": {"path": {"path_m": [[0, 0, 0], ..], "width_m": 0.01, "thickness_m": 0.004}},
///    "origin": {"points_m": [[-0.01, 0, 0]]}, "insertion": "free", "bed_n_per_m": 500
///
/// On a "plate", tendons end at points that keep the distances from each other that they have in the rest shape. On a "plane" at
/// the same distance from the belly, tendons stay perpendicular to it, wherever the end of the belly moves as it swells. Field
/// names are the keys.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "risorius/muscle/muscle_shape.h"
#include "risorius/muscle/musculotendon.h"
#include "risorius/softbody/body_description.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/tissue/cell_body.h"

namespace risorius::softbody {

/// How an end of a muscle is held.
struct MuscleEnd {
    enum class Hold { kPlate, kPlane, kBone, kFree };  ///< "plate", "plane", {"points_m"}, "free"
    Hold hold = Hold::kPlate;
    Points points_m = {};  ///< points of the bone; see muscle::bone_anchor
};

/// The fields of a muscle in a file.
struct MuscleDescription {
    enum class Section { kBlock, kRound };  ///< "block": a box; "round": a box mapped to a cylinder

    std::string place;  ///< the place in the file, for errors found when the body is built
    Discretisation discretisation = Discretisation::kCells;
    tissue::GridShape grid;  ///< a1 along the fibres
    Section section = Section::kRound;
    double length_m = 0, width_m = 0, thickness_m = 0;  ///< along x, y, z     (0, inf)
    std::optional<muscle::MuscleShape> shape = {};  ///< replaces the four fields above; needs cells
    MuscleEnd origin = {}, insertion = {};          ///< a ring has none
    /// Stiffness of the tissue around the belly, which holds rings and free ends: springs from every node to its rest position,
    /// all of them together.
    double bed_n_per_m = 0;           ///< [0, inf)
    tissue::CellModuli moduli;        ///< mu > 0; the others >= 0
    double density_kg_per_m3 = 1060;  ///< (0, inf)
    muscle::MuscleParameters musculotendon;
    Vec3 gravity_m_per_s2 = Vec3::Zero();

    /// For block and round, before the grid makes the surface polygonal.
    double rest_volume_m3() const;
};

/// Throws Error with file and JSON pointer. "grid" may be left out when the caller sets it.
MuscleDescription read_muscle(const JsonCursor& json);

/// What happens to a muscle.
struct MuscleTask {
    muscle::ActivationAt activation;
    /// Displacement of the insertion's plate along the line from anchor to anchor, m; empty: it stands still.
    std::function<double(double t_s)> lengthening_m = {};
};

/// A muscle that is ready to move.
struct MuscleBody {
    SoftBody body;
    std::shared_ptr<muscle::Musculotendon> musculotendon;

    /// Force on the anchors along the rest direction of the belly's ends, mean of both ends, divided by F0. With rigid tendons,
    /// it is the force without velocities and contains the stress of the belly. 0 when no end is anchored.
    double tension(double t_s, const Points& x) const;
};

/// Throws Error for parameters outside their ranges.
MuscleBody build_muscle(const MuscleDescription& description, MuscleTask task);

}  // namespace risorius::softbody
