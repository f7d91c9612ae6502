// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/anchors.h"

#include <stdexcept>
#include <vector>

namespace risorius::muscle {

Vec3 outward_at(End end, const tissue::GridShape& grid, const Points& rest) {
    const int chains = grid.n * grid.o;
    const int outer = end == End::kOrigin ? 0 : grid.m - 1;
    const int inner = end == End::kOrigin ? 1 : grid.m - 2;
    // Uses the mean direction of the outermost segments, so that a bent belly is met squarely.
    const Vec3 outward =
        (rest.middleRows(outer * chains, chains) - rest.middleRows(inner * chains, chains))
            .colwise()
            .sum();
    return outward.normalized();
}

Anchor planar_anchor(End end, const tissue::GridShape& grid, const Points& rest, double away_m) {
    const int chains = grid.n * grid.o;
    const Vec3 offset = outward_at(end, grid, rest) * away_m;
    Points points = rest.middleRows(end == End::kOrigin ? 0 : (grid.m - 1) * chains, chains);
    points.rowwise() += offset.transpose();
    return {.rest = points};
}

Anchor plane_anchor(End end, const tissue::GridShape& grid, const Points& rest, double away_m) {
    Anchor anchor = planar_anchor(end, grid, rest, away_m);
    anchor.normal = outward_at(end, grid, rest);
    return anchor;
}

Anchors planar_anchors(const tissue::GridShape& grid, const Points& rest, double tendon_slack_m) {
    return {planar_anchor(End::kOrigin, grid, rest, tendon_slack_m / 2),
            planar_anchor(End::kInsertion, grid, rest, tendon_slack_m / 2)};
}

Anchor bone_anchor(End end, const tissue::GridShape& grid, const Points& rest, const Points& bone) {
    if (bone.rows() == 0) throw std::invalid_argument("bone_anchor: no points");
    const int chains = grid.n * grid.o;
    std::vector<double> length = {0};
    for (Eigen::Index i = 1; i < bone.rows(); ++i)
        length.push_back(length.back() + (bone.row(i) - bone.row(i - 1)).norm());
    const auto along = [&](double fraction) -> Eigen::RowVector3d {
        const double wanted = fraction * length.back();
        Eigen::Index i = 1;
        while (i + 1 < bone.rows() && wanted > length[static_cast<std::size_t>(i)]) ++i;
        const double from = length[static_cast<std::size_t>(i) - 1];
        const double piece = length[static_cast<std::size_t>(i)] - from;
        const double t = piece > 0 ? (wanted - from) / piece : 0;
        return (1 - t) * bone.row(i - 1) + t * bone.row(i);
    };
    Anchor anchor{.rest = Points(chains, 3)};
    for (int c = 0; c < chains; ++c)
        anchor.rest.row(c) = bone.rows() == chains ? Eigen::RowVector3d(bone.row(c))
                             : bone.rows() == 1    ? Eigen::RowVector3d(bone.row(0))
                                                   : along((c / grid.o) / (grid.n - 1.0));
    anchor.slack_m =
        (anchor.rest - rest.middleRows(end == End::kOrigin ? 0 : (grid.m - 1) * chains, chains))
            .rowwise()
            .norm();
    return anchor;
}

}  // namespace risorius::muscle
