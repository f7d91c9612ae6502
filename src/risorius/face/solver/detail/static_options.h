// SPDX-License-Identifier: MIT
/// \file
/// Options of the search for a static equilibrium of the face.
#pragma once

#include <functional>

namespace risorius::face {

/// B is the inverse of the last factored stiffness matrix and g the gradient of the static energy, see static_solver.h.
struct StaticOptions {
    int iterations = 1500;  ///< maximum number of iterations of L-BFGS
    double tolerance_m =
        1e-6;  ///< the search has converged when |B g| is at most this on every node,
    double planes_m =
        1e-6;        ///< and no node has moved farther than this since the last contact search
    int round = 12;  ///< iterations between two contact searches
    int memory = 8;  ///< pairs of vectors that L-BFGS keeps
    double step_cap_m = 6e-3;            ///< maximum move of a node in one iteration
    std::function<bool()> stopped = {};  ///< asked between rounds; true ends the search where it is
};

}  // namespace risorius::face
