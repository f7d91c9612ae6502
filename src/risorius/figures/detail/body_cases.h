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

/// Returns the JSON of a body with `change` applied. Error messages name the file and the field within the changed body.
JsonCursor changed_json(const JsonCursor& body, const std::optional<JsonCursor>& change,
                        const std::string& case_name);

/// Returns the body with `change` applied. Error messages name the file and the field within the changed body.
softbody::BodyDescription changed_body(const JsonCursor& body,
                                       const std::optional<JsonCursor>& change,
                                       const std::string& case_name);

/// Returns the name of a grid, such as "3x3x3".
std::string grid_name(const tissue::GridShape& grid);

/// Reads a list of grids. Each is three numbers of nodes, one per axis, or one number for all axes.
std::vector<tissue::GridShape> read_grids(const JsonCursor& json);

/// One body of the "runs" of a file: the body with the change of the run, on one of the grids of the run.
struct BodyRun {
    std::string name, label;
    softbody::BodyDescription body;
    solve::IntegratorOptions integrator;
};

/// Reads "runs": [{"name": "cells", "label": "B", "change": {...}, "grids": [3, 5], "integrator": {...}}], one BodyRun per grid.
/// "steps_s" may give a time step per grid, which replaces that of the integrator.
std::vector<BodyRun> read_runs(const JsonCursor& experiment);

/// The estimated work of runs, and the order in which they start, most work first.
struct Workload {
    std::vector<std::size_t> order;
    std::vector<double> work;
    double whole = 0;
};
Workload workload_of(const std::vector<BodyRun>& runs);

/// Returns the body at positions x (N x 3, m) for drawing. If the material varies, Shape::shade goes from 0 at the softest node
/// to 1 at the stiffest one.
Shape shape_of(const softbody::BodyDescription& description, const softbody::SoftBody& body,
               const Points& x, const std::string& name, const std::string& caption);

/// The same for a body that is a mesh.
Shape shape_of(const softbody::SoftBody& body, const Points& x, const std::string& name,
               const std::string& caption);

/// Returns the edges of the rest shape of a body, in the format of Shape::outline.
Points rest_outline(const softbody::SoftBody& body);

/// How far apart the first and the last plane of nodes perpendicular to one axis are.
struct Extent {
    /// Distance of the centres of the two planes, measured along the direction of the axis at rest, over the distance at rest
    double length_ratio;
    /// Distance of the centres perpendicular to that direction, over the distance at rest
    double drift_ratio;
};
Extent extent_along(const softbody::SoftBody& body, const Points& x, int axis);

}  // namespace risorius::figures
