// SPDX-License-Identifier: MIT
/// \file
/// Options of the search for a static equilibrium of the face.
#pragma once

#include <functional>

namespace risorius::face {

/// Options of one search. B is the inverse of the last factorised stiffness matrix, g the gradient of the static energy (see
/// docs/theory/integrator.md).
struct StaticOptions {
    int iterations = 1500;  ///< maximum number of iterations of L-BFGS
    /// The search has converged when |B g| is at most tolerance_m on every node, and no node has moved farther than planes_m since the
    /// last contact search.
    double tolerance_m = 1e-6;
    double planes_m = 1e-6;
    int round = 12;                      ///< iterations between two contact searches
    int memory = 8;                      ///< pairs of vectors that L-BFGS keeps
    double step_cap_m = 6e-3;            ///< maximum move of a node in one iteration
    std::function<bool()> stopped = {};  ///< called between rounds; true ends the search
};

}  // namespace risorius::face
