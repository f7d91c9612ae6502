// SPDX-License-Identifier: MIT
/// \file
/// The integrator as an experiment file describes it: {"method": "rkck", "step_s": 1e-3, "tolerance": 1e-6}.
#pragma once

#include "risorius/core/json_cursor.h"
#include "risorius/solve/integrator.h"

namespace risorius::softbody {

/// Keys are the fields of solve::IntegratorOptions, except length_scale_m, which comes from the body. "method" is required.
/// Throws Error for values out of range.
solve::IntegratorOptions read_integrator(const JsonCursor& json);

}  // namespace risorius::softbody
