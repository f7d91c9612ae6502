// What the groups of an unknown mesh are, told from their names: "Eyeball_L" is the left eye.
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
    std::vector<std::string> notes;                         ///< what was left out, and why
};

/// The role a name suggests, or "" when it suggests none. Eyes and corneas come without a side when the name has none:
/// "eye", "cornea".
std::string role_suggested_by(const std::string& group);

/// `given` roles win. A mesh of one group is skin. `left_of`, positive for points nearer to the subject's left, decides
/// on eyes whose names have no side.
PartGuess guess_parts(const geom::PolygonMesh& mesh,
                      const std::map<std::string, std::vector<std::string>>& given,
                      const std::function<double(const Vec3& mesh_units)>& left_of);

}  // namespace risorius::fitting
