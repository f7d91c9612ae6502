// SPDX-License-Identifier: MIT
/// \file
/// Guesses the roles of an unknown mesh's groups from their names: "Eyeball_L" is the left eye.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/rig_description.h"

namespace risorius::fitting {

struct PartGuess {
    std::map<std::string, std::vector<std::string>> parts;  ///< role -> groups
    std::vector<std::string> notes;  ///< groups that got no role, and the reason
};

/// The role that a name suggests, or "" when it suggests none. For eyes and corneas without a side in the name: "eye", "cornea".
std::string role_suggested_by(const std::string& group);

/// `given` roles take precedence. A mesh with one group is skin. `left_of`, positive for points nearer to the subject's left, decides the
/// side of eyes whose names have none.
PartGuess guess_parts(const geom::PolygonMesh& mesh,
                      const std::map<std::string, std::vector<std::string>>& given,
                      const std::function<double(const Vec3& mesh_units)>& left_of);

}  // namespace risorius::fitting
