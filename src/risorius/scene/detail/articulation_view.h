// SPDX-License-Identifier: MIT
/// \file
/// The mouth in section, as books of phonetics draw it: lips, teeth, gums, tongue and the inside of the mouth in the median plane.
///
/// The face looks to the left. The picture covers 100 mm of an average head and does not move with the head. Teeth are cut a little
/// beside the middle, where there is no gap between them.
#pragma once

#include <array>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/render/scene.h"
#include "risorius/rig/head.h"

namespace risorius::scene {

class ArticulationView {
  public:
    ArticulationView(const render::Scene& scene, const rig::Head& head);

    /// Replaces the picture. `positions`: of the vertices of the scene, V x 3, m.
    void draw(const Points& positions, Image& image) const;

  private:
    struct Part {
        Triangles triangles;
        Vec3 ink;
        double fill, line;  ///< line: as a fraction of the picture's height
        double beside_mm;   ///< of the median plane
    };
    /// Axes from three vertices that the skull carries, and their origin.
    Rigid skull_of(const Points& positions) const;

    std::vector<Part> parts_;
    Points rest_;
    std::array<int, 3> rigid_{-1, -1, -1};  ///< upper teeth; -1: the head does not move
    double middle_x_, mouth_y_, lips_z_, millimetre_;
};

}  // namespace risorius::scene
