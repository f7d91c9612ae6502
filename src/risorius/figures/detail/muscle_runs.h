// SPDX-License-Identifier: MIT
/// \file
/// Variations of one muscle for the kinds that experiment on it: an experiment file gives a muscle (softbody/muscle_body.h) and
/// what each run changes in it.
///
///   "muscle": {...}, "runs": [{"name": "k-0.2", "label": "K = 0.2 MPa", "change": {"moduli": {"bulk_pa": 2e5}}}]
///
/// Lengths of a musculotendon are normalised as in the thesis' figure 11a: (distance of the plates - lTs) / l0, which is 1 at
/// rest for a belly of its optimal length.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/figures/detail/figure_result.h"
#include "risorius/softbody/muscle_body.h"

namespace risorius::figures {

struct MuscleRun {
    std::string name, label;
    softbody::MuscleDescription muscle;
    JsonCursor json;  ///< of the run, for what else a kind reads there
};

/// "runs" of the experiment: straight bellies between two plates, each with keys "name", "label", "change" and those a kind adds.
std::vector<MuscleRun> read_muscle_runs(const JsonCursor& experiment,
                                        const std::vector<std::string_view>& more_keys = {});

/// The same of muscles of any shape, held in any way.
std::vector<MuscleRun> read_runs_of_any_muscle(const JsonCursor& experiment,
                                               const std::vector<std::string_view>& more_keys = {});

/// Tension is known of moving muscles with elastic tendons. Throws Error.
void require_elastic_tendons(const MuscleRun& run);

/// "6x6x6 cells, K = 5 MPa"
std::string discretisation_of(const softbody::MuscleDescription& muscle);

inline constexpr Range kNormalisedLengths{0.1, 3};  ///< a file may ask for

/// How far the plates of a muscle at rest have to be moved apart for a normalised length, m; and back.
double lengthening_m(const softbody::MuscleDescription& muscle, double normalised_length);
double normalised_length(const softbody::MuscleDescription& muscle, double lengthening_m);

/// Whether nothing moves it: no node is out of balance by more than 1e-9 F0. A muscle between slack tendons floats, and no
/// equation says where.
bool is_at_rest(const softbody::MuscleBody& muscle, const solve::MotionState& state);

/// What a muscle looks like: belly, tendons as lines, plates.
Shape muscle_shape(const softbody::MuscleBody& muscle, double t_s, const Points& x,
                   const std::string& name, const std::string& caption);

/// Width of the middle of the belly over that at rest: root of the ratio of its sections' areas.
double bulge(const softbody::SoftBody& body, const Points& x);

}  // namespace risorius::figures
