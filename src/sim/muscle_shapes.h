// How the muscles of a face look now: what a picture of the inside draws. Same frame as FacePose::vertices.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/types.h"

namespace risorius::sim {

/// One muscle, or one side of it. Which muscles there are, their order, triangles and fibres never change; positions do.
struct MuscleShape {
    std::string muscle;       ///< its id in the table of muscles
    Side side = Side::kLeft;  ///< left for unpaired ones
    double activation = 0;    ///< 0..1; of a ring the greatest of its parts
    Points positions{};       ///< P x 3, m
    /// F x 3, the closed surface of a volume muscle, outwards; empty for a bundle.
    Triangles triangles{};
    std::vector<std::pair<int, int>>
        fibres{};              ///< of a bundle: first position and count, polylines
    double fibre_width_m = 0;  ///< that a fibre stands for
};

using MuscleShapes = std::vector<MuscleShape>;

}  // namespace risorius::sim
