// SPDX-License-Identifier: MIT
/// \file
/// Guesses the roles of the groups of a mesh from their names: "Eyeball_L" is the left eye.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/rig_description.h"

namespace risorius::fitting {

/// Result of guess_parts().
struct PartGuess {
    std::map<std::string, std::vector<std::string>> parts;  ///< role -> groups
    std::vector<std::string> notes;  ///< groups without a role, and the reason
};

/// Returns the role that the name of a group suggests, or "". Eyes and corneas without a side in the name give "eye" and
/// "cornea".
std::string role_suggested_by(const std::string& group);

/// Guesses all roles. Roles of `given` take precedence. The only group of a mesh is skin. `left_of` is positive for points to the
/// subject's left; it decides the side of eyes whose names have none.
PartGuess guess_parts(const geom::PolygonMesh& mesh,
                      const std::map<std::string, std::vector<std::string>>& given,
                      const std::function<double(const Vec3& mesh_units)>& left_of);

}  // namespace risorius::fitting
