// SPDX-License-Identifier: MIT
/// \file
/// Deforms the average head into that of a person. The handles of the parameters table move every part; the topology does not
/// change.
///
/// A handle is at the point `at` and acts within the distance `reach`. Its weight k at the distance d is Wendland's bell,
/// (1 - t)^4 (4 t + 1) with t = d / reach. A point p of the left side moves to
///   p + sum over handles of  parameter * k * by                (move)
///                            parameter * k * by (p - at) / 100 (scale)
/// The right side is the mirror image; lean handles move it the other way instead. Near each globe the displacement fades into that of
/// the globe's centre, so that globes keep their
/// form and lids their distance. Then lid handles slide the lids over the globe, and near and corner handles move what lies in front of it, which keeps 0.6 of its
/// distance at least. The map is smooth and, within the ranges of identity.h,
/// one-to-one, so a mesh without self-intersections stays free of them. Last, steps in the skin of a person of the population are eased
/// (skin_steps.h).
#pragma once

#include "risorius/headmodel/detail/head_model.h"
#include "risorius/headmodel/detail/identity.h"
#include "risorius/headmodel/head_quality.h"

namespace risorius::headmodel {

/// Limit of the deviation of a measure from the mean of the sex, in standard deviations.
inline constexpr double kLargestDeviation = 2.5;

/// Returns the head of an identity. The average identity gives exactly the average head.
HeadModel deform_head(const HeadModel& average, const DesignTables& tables,
                      const Identity& identity);

/// Does the same, but scales all shape parameters down together until every measure is within kLargestDeviation. `identity`
/// receives the values that were used.
HeadModel deform_within_spread(const HeadModel& average, const DesignTables& tables,
                               Identity& identity);

/// Throws Error that names the measure beyond kLargestDeviation.
void check_spread(const HeadModel& model, const DesignTables& tables, const Identity& identity,
                  const std::string& place);

}  // namespace risorius::headmodel
