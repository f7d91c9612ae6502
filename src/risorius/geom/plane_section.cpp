// SPDX-License-Identifier: MIT
#include "risorius/geom/plane_section.h"

namespace risorius::geom {

std::vector<std::pair<Vec2, Vec2>> plane_section(const Triangles& triangles, const Points& vertices,
                                                 double at) {
    std::vector<std::pair<Vec2, Vec2>> out;
    for (long f = 0; f < triangles.rows(); ++f) {
        Vec2 ends[2];
        int count = 0;
        for (int k = 0; k < 3 && count < 2; ++k) {
            const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
            const double xa = vertices(a, 0) - at, xb = vertices(b, 0) - at;
            if ((xa < 0) == (xb < 0)) continue;
            const double s = xa / (xa - xb);
            ends[count++] = Vec2((1 - s) * vertices(a, 1) + s * vertices(b, 1),
                                 (1 - s) * vertices(a, 2) + s * vertices(b, 2));
        }
        if (count == 2) out.emplace_back(ends[0], ends[1]);
    }
    return out;
}

}  // namespace risorius::geom
