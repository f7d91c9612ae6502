// The average head turned into somebody: every part moved by the handles of the parameters table, its topology kept.
//
// With k(d / reach) Wendland's bell (1 - t)^4 (4 t + 1) about each handle, a point p of the left side goes to
//   p + sum over handles of  parameter * k * by                (move)
//                            parameter * k * by (p - at) / 100 (scale)
// and the right side mirrors it. Round each globe the displacement fades into that of the globe's centre, so that globes
// keep their form and lids their distance; lid handles then slide lids over the globe. The map is smooth and, within the
// ranges of identity.h, one to one: what does not run through itself on the average head does not on the others.
#pragma once

#include "risorius/headmodel/detail/head_model.h"
#include "risorius/headmodel/detail/identity.h"
#include "risorius/headmodel/head_quality.h"

namespace risorius::headmodel {

/// Measures of a person lie within so many standard deviations of the mean of the sex.
inline constexpr double kLargestDeviation = 2.5;

/// The average identity gives the average head to the bit.
HeadModel deform_head(const HeadModel& average, const DesignTables& tables,
                      const Identity& identity);

/// As above, but with shapes scaled down together, at most to nothing, until every measure is within kLargestDeviation;
/// `identity` receives the shapes used.
HeadModel deform_within_spread(const HeadModel& average, const DesignTables& tables,
                               Identity& identity);

/// Throws Error naming the measure that is beyond kLargestDeviation.
void check_spread(const HeadModel& model, const DesignTables& tables, const Identity& identity,
                  const std::string& place);

}  // namespace risorius::headmodel
