// Which correctives are worth their bytes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "shapes/linear_rig.h"

namespace risorius::shapes {

struct OfferedCorrective {
    Corrective corrective;
    double use = 0;  ///< squares of error that it removes on average, m^4
    long bytes = 0;
    std::size_t group =
        0;  ///< neighbours of one group, as a left and a right one, are kept together or not at all
};

/// A frame that the rig will be played with.
struct PlayedFrame {
    Eigen::VectorXd weights;  ///< of the shapes
    Points left;              ///< V x 3, m: what the plain sum of shapes leaves of the true frame
};

/// Indices of those to be kept, within the budget: one after the other those that take most off the frames for their size, in fourth
/// powers of the error (the greatest errors first), each with those before it in place; then, by use for their size, those that
/// put hardly anything on them. Without frames by use alone. `area`: of the vertices, m^2.
std::vector<std::size_t> choose_correctives(const std::vector<OfferedCorrective>& offered,
                                            std::vector<PlayedFrame> frames,
                                            const Eigen::VectorXd& area, long budget_bytes);

}  // namespace risorius::shapes
