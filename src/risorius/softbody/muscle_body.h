// SPDX-License-Identifier: MIT
/// \file
/// A muscle by itself: a belly of grid solid with its musculotendon, held between two plates. The test bench of Zajac's and
/// of Gasser and Hill's experiments, and of the stability of integration methods.
///
///   {"discretisation": "cells", "grid": [6, 6, 6], "section": "round", "length_m": 0.04, "width_m": 0.02,
///    "thickness_m": 0.02,
///    "moduli": {"shear_pa": 2000, "bulk_pa": 5e6, "viscosity_pa_s": 200, "density_kg_per_m3": 1060},
///    "musculotendon": {"f0_n": 94.2, "optimal_length_m": 0.04, "tendon_slack_m": 0.02}}
///
/// The belly lies along x with its axis through the origin, from x = 0; plates stand half the tendon slack length away
/// from its ends. In place of "section" and the three sizes any shape of muscle/muscle_shape.h may stand, and in place of
/// a plate nothing or points of a bone:
///
///    "shape": {"path": {"path_m": [[0, 0, 0], ..], "width_m": 0.01, "thickness_m": 0.004}},
///    "origin": {"points_m": [[-0.01, 0, 0]]}, "insertion": "free", "bed_n_per_m": 500
///
/// Tendons end in points of a "plate", which keep the distances they have at rest; on a "plane", as far away, they stand square
/// wherever the belly's end goes as it swells.
///
/// Field names are the keys.
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
    Points points_m = {};  ///< of the bone, muscle::bone_anchor
};

struct MuscleDescription {
    enum class Section {
        kBlock,
        kRound
    };  ///< "block": a box; "round": a box pressed into a cylinder

    std::string place;  ///< where it was written, for errors found on building
    Discretisation discretisation = Discretisation::kCells;
    tissue::GridShape grid;  ///< a1 along the fibres
    Section section = Section::kRound;
    double length_m = 0, width_m = 0, thickness_m = 0;  ///< along x, y, z     (0, inf)
    std::optional<muscle::MuscleShape> shape =
        {};                                 ///< takes the place of the four above; needs cells
    MuscleEnd origin = {}, insertion = {};  ///< a ring has none
    /// Tissue around the belly, what holds rings and free ends: springs from every node to where it rests, together.
    double bed_n_per_m = 0;           ///< [0, inf)
    tissue::CellModuli moduli;        ///< mu > 0; the others >= 0
    double density_kg_per_m3 = 1060;  ///< (0, inf)
    muscle::MuscleParameters musculotendon;
    Vec3 gravity_m_per_s2 = Vec3::Zero();

    double rest_volume_m3() const;  ///< of block and round, before the grid makes them angular
};

/// Throws Error with file and JSON pointer. "grid" may be left out where the caller sets it.
MuscleDescription read_muscle(const JsonCursor& json);

/// What is done to a muscle.
struct MuscleTask {
    muscle::ActivationAt activation;
    /// How far the insertion's plate is moved off along the line from anchor to anchor, m; empty: it stands.
    std::function<double(double t_s)> lengthening_m = {};
};

struct MuscleBody {
    SoftBody body;
    std::shared_ptr<muscle::Musculotendon> musculotendon;

    /// What the anchors feel along the ends of the belly as they lie at rest, mean of both, over F0. Of rigid tendons as
    /// the muscle stands still, the stress of the belly included. 0 where no end is anchored.
    double tension(double t_s, const Points& x) const;
};

/// Throws Error for parameters outside their ranges.
MuscleBody build_muscle(const MuscleDescription& description, MuscleTask task);

}  // namespace risorius::softbody
