// SPDX-License-Identifier: MIT
/// \file
/// Fields of a face and derivatives by numbers of its rig, for Python.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/face.h"
#include "risorius/track/channels.h"

namespace risorius::python {

/// The fields of face/fields.h after the last step or equilibrium: {"tissue", "fibres", "solids"}, dicts of arrays that are copies.
pybind11::dict fields_dict(face::Face& face);

/// Returns dL/d(ln p) for each path of numbers of the rig (study/rig_numbers.h), in the equilibrium of the face with `drive`:
///
///   dL/dp = dL/dv . (dv/dx dx/dp + dv/dp),   dx/dp = - H^-1 dg/dp        face/statics.h
///
/// Derivatives are differences of two rigs with p e^(-h) and p e^h: of g at the same nodes x, and of the vertices v with the skin over the
/// nodes. Contact is left out. Throws Error for a
/// path without numbers, and for numbers of the mesh of the tissue, which needs other nodes.
Eigen::VectorXd rig_gradient(face::Face& face, const std::filesystem::path& rig,
                             const track::Drive& drive, const Points& vertex_gradient,
                             const std::vector<std::string>& paths);

}  // namespace risorius::python
