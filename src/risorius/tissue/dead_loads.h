// SPDX-License-Identifier: MIT
/// \file
/// Constant forces on nodes, N. A force keeps its size and direction while the tissue moves. Examples are weight and air
/// pressure held in the cheeks.
#pragma once

#include <utility>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::tissue {

/// The list of loads and their energy.
class DeadLoads {
  public:
    struct Load {
        int node = 0;
        Vec3 force_n = Vec3::Zero();
    };

    void set(std::vector<Load> loads) { loads_ = std::move(loads); }
    const std::vector<Load>& list() const { return loads_; }

    /// Returns E = -sum f . x, J, and adds dE/dx = -f to `gradient`, n x 3, N. f is the force on a node and x is its position.
    double add_energy(const Points& x, Points& gradient) const {
        double energy = 0;
        for (const Load& load : loads_) {
            energy -= x.row(load.node).dot(load.force_n.transpose());
            gradient.row(load.node) -= load.force_n.transpose();
        }
        return energy;
    }

  private:
    std::vector<Load> loads_;
};

}  // namespace risorius::tissue
