// SPDX-License-Identifier: MIT
/// \file
/// A single muscle between two plates: its belly is a grid solid with a musculotendon. It is used for the experiments of Zajac
/// and of Gasser and Hill, and for tests of the stability of integration methods.
///
///   {"discretisation": "cells", "grid": [6, 6, 6], "section": "round", "length_m": 0.04, "width_m": 0.02,
///    "thickness_m": 0.02,
///    "moduli": {"shear_pa": 2000, "bulk_pa": 5e6, "viscosity_pa_s": 200, "density_kg_per_m3": 1060},
///    "musculotendon": {"f0_n": 94.2, "optimal_length_m": 0.04, "tendon_slack_m": 0.02}}
///
/// The belly extends along x from x = 0, and its axis goes through the origin. The distance of each plate from its end of the
/// belly is half the tendon slack length. A shape of muscle/muscle_shape.h may replace "section" and the three sizes. Points of
/// a bone, or nothing, may replace a plate:
///
///    "shape": {"path": {"path_m": [[0, 0, 0], ..], "width_m": 0.01, "thickness_m": 0.004}},
///    "origin": {"points_m": [[-0.01, 0, 0]]}, "insertion": "free", "bed_n_per_m": 500
///
/// On a "plate", tendons end at points that keep the distances from each other that they have in the rest shape. On a "plane"
/// at the same distance from the belly, tendons stay perpendicular to it, wherever the end of the belly moves as it swells.
/// "bed_n_per_m" is the stiffness of the tissue around the belly. The field names are the keys.
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
    std::optional<muscle::MuscleShape> shape = {};  ///< replaces section and sizes; needs kCells
    MuscleEnd origin = {}, insertion = {};          ///< not for a ring
    /// Stiffness of the tissue around the belly, which holds rings and free ends. It is the sum over springs from every node to
    /// its rest position.
    double bed_n_per_m = 0;           ///< [0, inf)
    tissue::CellModuli moduli;        ///< mu > 0; the others >= 0
    double density_kg_per_m3 = 1060;  ///< (0, inf)
    muscle::MuscleParameters musculotendon;
    Vec3 gravity_m_per_s2 = Vec3::Zero();

    /// Exact volume of the block or round section and length, m^3. The grid of a round belly has flat sides, so its volume is
    /// smaller.
    double rest_volume_m3() const;
};

/// Reads a muscle. "grid" may be left out; then the caller sets it. Throws Error; its message names the file and the JSON
/// pointer.
MuscleDescription read_muscle(const JsonCursor& json);

/// What is done to a muscle.
struct MuscleTask {
    muscle::ActivationAt activation;
    /// Displacement of the plate of the insertion along the line from anchor to anchor, m. Empty: the plate does not move.
    std::function<double(double t_s)> lengthening_m = {};
};

/// A muscle that is ready to move.
struct MuscleBody {
    SoftBody body;
    std::shared_ptr<muscle::Musculotendon> musculotendon;

    /// Force on the anchors along the rest direction of the ends of the belly, divided by F0. It is the mean of both ends, and
    /// 0 when no end is anchored. With rigid tendons, it is the force without velocities, and it contains the stress of the
    /// belly.
    double tension(double t_s, const Points& x) const;
};

/// Builds the muscle. Throws Error for parameters outside their ranges.
MuscleBody build_muscle(const MuscleDescription& description, MuscleTask task);

}  // namespace risorius::softbody
