// SPDX-License-Identifier: MIT
#include "risorius/face/muscle/detail/muscle_surface.h"

namespace risorius::face {

MuscleSurface& MuscleSurfaces::of(const std::string& muscle, std::optional<Side> side, int column) {
    for (MuscleSurface& surface : muscles)
        if (surface.muscle == muscle && surface.side == side) return surface;
    MuscleSurface surface;
    surface.muscle = muscle;
    surface.side = side;
    surface.column = column;
    muscles.push_back(surface);
    return muscles.back();
}

void MuscleSurfaces::add(MuscleSurface& muscle, const Points& vertices,
                         const TexCoords& along_across, const std::vector<double>& tendon_fraction,
                         const Triangles& triangles) {
    const auto first = rest.rows();
    rest.conservativeResize(first + vertices.rows(), 3);
    rest.bottomRows(vertices.rows()) = vertices;
    fibre.conservativeResize(first + vertices.rows(), 2);
    fibre.bottomRows(vertices.rows()) = along_across;
    tendon.insert(tendon.end(), tendon_fraction.begin(), tendon_fraction.end());
    const auto faces = muscle.triangles.rows();
    muscle.triangles.conservativeResize(faces + triangles.rows(), 3);
    muscle.triangles.bottomRows(triangles.rows()) = triangles.array() + static_cast<int>(first);
}

}  // namespace risorius::face
