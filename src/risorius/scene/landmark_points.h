// SPDX-License-Identifier: MIT
/// \file
/// Positions of the landmarks of a head on a moving face. Each landmark moves with one vertex of the mesh.
#pragma once

#include <map>
#include <string>

#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"

namespace risorius::scene {

class LandmarkPoints {
  public:
    LandmarkPoints(const rig::Head& head, const rig::RigDescription& rig);

    /// Position of a landmark in the world, m. `vertices`: V x 3, m, in the order of the mesh.
    Vec3 at(const std::string& id, const Points& vertices) const;
    double distance(const std::string& a, const std::string& b, const Points& vertices) const {
        return (at(a, vertices) - at(b, vertices)).norm();
    }
    int vertex(const std::string& id) const { return riders_.at(id).vertex; }
    std::vector<std::string> ids() const;

  private:
    struct Rider {
        int vertex;
        Vec3 offset;  ///< from the vertex at rest, for landmarks that the rig gives as points
    };
    std::map<std::string, Rider> riders_;
};

}  // namespace risorius::scene
