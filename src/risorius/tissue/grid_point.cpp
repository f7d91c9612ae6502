// SPDX-License-Identifier: MIT
#include "risorius/tissue/grid_point.h"

#include <algorithm>
#include <cmath>

namespace risorius::tissue {

solve::NodeBlend point_of_grid(const GridShape& grid, const Vec3& a) {
    int cell[3];
    double fraction[3];  // weight of the upper corner
    for (int axis = 0; axis < 3; ++axis) {
        const int cells = grid.along(axis) - 1;
        const double place = std::clamp(a(axis), 0.0, 1.0) * cells;
        cell[axis] = std::min(static_cast<int>(std::floor(place)), cells - 1);
        fraction[axis] = place - cell[axis];
    }
    solve::NodeBlend point;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            for (int k = 0; k < 2; ++k)
                point.add(grid.index(cell[0] + i, cell[1] + j, cell[2] + k),
                          (i ? fraction[0] : 1 - fraction[0]) *
                              (j ? fraction[1] : 1 - fraction[1]) *
                              (k ? fraction[2] : 1 - fraction[2]));
    return point;
}

}  // namespace risorius::tissue
