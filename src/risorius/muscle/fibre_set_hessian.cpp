// SPDX-License-Identifier: MIT
// The second derivative of the static energy of FibreSet. For a segment of length l along u with tension T, by the difference
// of its ends:
//   T/s (I - u u^T) + dT/ds u u^T,     T = F0 (a fl + fp) dl/ds,     dT/ds = F0 / l0 (a fl' + fp') (dl/ds)^2 + F0 (a fl + fp) d2l/ds2
// s is the length of a segment and l that of its fibres; both are the same without tendon and pennation.
#include <algorithm>
#include <cassert>

#include "risorius/muscle/fibre_set.h"
#include "risorius/solve/energy_term.h"

namespace risorius::muscle {

void FibreSet::add_hessian(const Points& x, const Eigen::VectorXd& activation,
                           solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    assert(step_s_ == 0);
    place_points(x);
    for (const Fibre& fibre : fibres_) {
        const double a = activation[fibre.column];
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            // Nodes of both ends. When the ends lie in tets with common nodes, those are listed once.
            int node[8];
            double c[8];
            int count = 0;
            for (int end = 0; end < 2; ++end) {
                const FibrePoint& point = points_[static_cast<std::size_t>(p + end)];
                for (int i = 0; i < point.count; ++i) {
                    const double weight = end == 0 ? -point.weights[i] : point.weights[i];
                    const int at =
                        static_cast<int>(std::find(node, node + count, point.nodes[i]) - node);
                    if (at < count) {
                        c[at] += weight;
                    } else {
                        node[count] = point.nodes[i];
                        c[count++] = weight;
                    }
                }
            }

            const double l0 = optimal_length_m_[static_cast<std::size_t>(p)];
            const double s = length(p);
            const FibreLength now = fibre_length(fibre, p, s);
            const double l = now.length_m, lam = l / l0;
            Mat3 block = Mat3::Zero();
            if (s > 0 && l > 0 && (a != 0 || lam > 1)) {
                const double pull =
                    fibre.f0_n * (a * curves_.active(lam).force + curves_.passive(lam).force);
                double along =
                    fibre.f0_n / l0 * (a * curves_.active_slope(lam) + curves_.passive_slope(lam));
                double across = pull / s;
                if (!fibre.plain()) {
                    along = along * now.slope * now.slope + pull * (1 - now.slope * now.slope) / l;
                    across *= now.slope;
                }
                if (curvature == solve::Curvature::kPositive) {
                    along = std::max(along, 0.0);
                    across = std::max(across, 0.0);
                }
                const solve::Lanes d = position_[p + 1] - position_[p];
                const Vec3 u = Vec3(d[0], d[1], d[2]) / s;
                block = across * Mat3::Identity() + (along - across) * u * u.transpose();
            }
            for (int i = 0; i < count; ++i)
                for (int j = 0; j <= i; ++j) hessian.add(node[i], node[j], c[i] * c[j] * block);
        }
    }
}

}  // namespace risorius::muscle
