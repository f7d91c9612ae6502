// SPDX-License-Identifier: MIT
/// \file
/// Variations of one body: the experiment file gives a body, and each case gives changes to it.
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

/// Applies `change` to the body. Errors name the file and the place within the changed body.
softbody::BodyDescription changed_body(const JsonCursor& body,
                                       const std::optional<JsonCursor>& change,
                                       const std::string& case_name);

/// The name of a grid, such as "3x3x3".
std::string grid_name(const tissue::GridShape& grid);

/// Reads a list of grids; each is three numbers, or one for all axes.
std::vector<tissue::GridShape> read_grids(const JsonCursor& json);

/// One body of the "runs" of a file: the body with the change of the run, at one of its grids.
struct BodyRun {
    std::string name, label;
    softbody::BodyDescription body;
    solve::IntegratorOptions integrator;
};

/// Reads "runs": [{"name": "cells", "label": "B", "change": {...}, "grids": [3, 5], "integrator": {...}}], one BodyRun per grid.
/// "steps_s" may give a time step per grid, which replaces that of the integrator.
std::vector<BodyRun> read_runs(const JsonCursor& experiment);

/// The order in which runs start, most work first, and the estimated work of each, in arbitrary units.
struct Workload {
    std::vector<std::size_t> order;
    std::vector<double> work;
    double whole = 0;
};
Workload workload_of(const std::vector<BodyRun>& runs);

/// The body at positions x for drawing. Where the material varies, shade goes from 0 at its softest node to 1 at its stiffest.
Shape shape_of(const softbody::BodyDescription& description, const softbody::SoftBody& body,
               const Points& x, const std::string& name, const std::string& caption);

/// Edges of the rest shape of a body, as Shape::outline.
Points rest_outline(const softbody::SoftBody& body);

/// Distances between the first and the last plane of nodes across one axis.
struct Extent {
    /// Distance of the centres of the planes along the rest direction of the axis, over that at rest
    double length_ratio;
    double drift_ratio;  ///< distance perpendicular to that direction, over the length at rest
};
Extent extent_along(const softbody::SoftBody& body, const Points& x, int axis);

}  // namespace risorius::figures
