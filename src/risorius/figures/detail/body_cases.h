// SPDX-License-Identifier: MIT
/// \file
/// Variations of one body: the experiment file gives a body and what each case changes in it.
///
///   "body": {...}, "change": {"grid": [4, 4, 4], "material": {"mass_kg": 10}}     a JSON merge patch (RFC 7386)
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/figures/detail/figure_result.h"
#include "risorius/softbody/body_description.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"

namespace risorius::figures {

/// The body with `change` put over it. Errors name the file and the place within the changed body.
softbody::BodyDescription changed_body(const JsonCursor& body,
                                       const std::optional<JsonCursor>& change,
                                       const std::string& case_name);

/// "3x3x3"
std::string grid_name(const tissue::GridShape& grid);

/// A list of grids, each three numbers or one for all axes.
std::vector<tissue::GridShape> read_grids(const JsonCursor& json);

/// One body of a file's "runs": the body with the run's change, at one of its grids.
struct BodyRun {
    std::string name, label;
    softbody::BodyDescription body;
    solve::IntegratorOptions integrator;
};

/// "runs": [{"name": "cells", "label": "B", "change": {...}, "grids": [3, 5], "integrator": {...}}], grid by grid;
/// "steps_s" may give each grid a step of its own in place of the integrator's.
std::vector<BodyRun> read_runs(const JsonCursor& experiment);

/// The order in which to run them, the most work first, and the work of each: about the time it takes, in any unit.
struct Workload {
    std::vector<std::size_t> order;
    std::vector<double> work;
    double whole = 0;
};
Workload workload_of(const std::vector<BodyRun>& runs);

/// The body at x for drawing; where the material varies, shade goes from 0 at its softest node to 1 at its stiffest.
Shape shape_of(const softbody::BodyDescription& description, const softbody::SoftBody& body,
               const Points& x, const std::string& name, const std::string& caption);

/// The edges of a body's rest shape, as Shape::outline.
Points rest_outline(const softbody::SoftBody& body);

/// Lengths between the first and the last plane of nodes across one axis.
struct Extent {
    double
        length_ratio;  ///< distance of their centres along the axis' rest direction, over that at rest
    double drift_ratio;  ///< distance across that direction, over the length at rest
};
Extent extent_along(const softbody::SoftBody& body, const Points& x, int axis);

}  // namespace risorius::figures
