// SPDX-License-Identifier: MIT
/// \file
/// The description of an integrator in an experiment file: {"method": "rkck", "step_s": 1e-3, "tolerance": 1e-6}.
#pragma once

#include "risorius/core/json_cursor.h"
#include "risorius/solve/integrator.h"

namespace risorius::softbody {

/// Reads an integrator. The keys are the fields of solve::IntegratorOptions, except length_scale_m, which is determined by the
/// body. "method" is required. Throws Error for values out of range.
solve::IntegratorOptions read_integrator(const JsonCursor& json);

}  // namespace risorius::softbody
