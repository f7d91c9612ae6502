// SPDX-License-Identifier: MIT
/// \file
/// Variations of one muscle: an experiment file gives a muscle (softbody/muscle_body.h), and each run gives changes to it.
///
///   "muscle": {...}, "runs": [{"name": "k-0.2", "label": "K = 0.2 MPa", "change": {"moduli": {"bulk_pa": 2e5}}}]
///
/// Lengths of a musculotendon are normalised as in figure 11a of the thesis (see registry.h): (distance of the plates - lTs) /
/// l0. Here lTs is the slack length of the tendons and l0 the optimal length of the fibres. The normalised length is 1 at rest
/// for a belly of its optimal length.
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
    JsonCursor json;  ///< the run in the file, for further keys of a kind
};

/// Reads the "runs" of the experiment: straight bellies between two plates. Each run has the keys "name", "label", "change" and
/// `more_keys`.
std::vector<MuscleRun> read_muscle_runs(const JsonCursor& experiment,
                                        const std::vector<std::string_view>& more_keys = {});

/// The same for muscles of any shape and any kind of anchors.
std::vector<MuscleRun> read_runs_of_any_muscle(const JsonCursor& experiment,
                                               const std::vector<std::string_view>& more_keys = {});

/// Throws Error for rigid tendons, because the tension of a moving muscle is measured on its elastic tendons.
void require_elastic_tendons(const MuscleRun& run);

/// Returns a description of grid and bulk_pa: "6x6x6 cells, K = 5 MPa".
std::string discretisation_of(const softbody::MuscleDescription& muscle);

inline constexpr Range kNormalisedLengths{0.1, 3};  ///< allowed lengths in a file

/// These two functions convert between a normalised length and the change of the distance of the plates since rest, m.
double lengthening_m(const softbody::MuscleDescription& muscle, double normalised_length);
double normalised_length(const softbody::MuscleDescription& muscle, double lengthening_m);

/// Returns whether the muscle is in equilibrium without any load: the residual force on every node is at most 1e-9 F0. Slack
/// tendons do not hold a muscle, so its position is undetermined then.
bool is_at_rest(const softbody::MuscleBody& muscle, const solve::MotionState& state);

/// Returns the muscle for drawing: the belly, the tendons as lines, and the plates at the time t_s.
Shape muscle_shape(const softbody::MuscleBody& muscle, double t_s, const Points& x,
                   const std::string& name, const std::string& caption);

/// Returns the width of the middle of the belly over that at rest, the square root of the ratio of the areas of its section.
double bulge(const softbody::SoftBody& body, const Points& x);

}  // namespace risorius::figures
