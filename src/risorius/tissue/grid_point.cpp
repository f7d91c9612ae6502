// SPDX-License-Identifier: MIT
#include "risorius/tissue/grid_point.h"

#include <algorithm>
#include <cmath>

namespace risorius::tissue {

solve::NodeBlend point_of_grid(const GridShape& grid, const Vec3& a) {
    int cell[3];
    double share[3];  // of the upper corner
    for (int axis = 0; axis < 3; ++axis) {
        const int cells = grid.along(axis) - 1;
        const double place = std::clamp(a(axis), 0.0, 1.0) * cells;
        cell[axis] = std::min(static_cast<int>(std::floor(place)), cells - 1);
        share[axis] = place - cell[axis];
    }
    solve::NodeBlend point;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            for (int k = 0; k < 2; ++k)
                point.add(grid.index(cell[0] + i, cell[1] + j, cell[2] + k),
                          (i ? share[0] : 1 - share[0]) * (j ? share[1] : 1 - share[1]) *
                              (k ? share[2] : 1 - share[2]));
    return point;
}

}  // namespace risorius::tissue
