// SPDX-License-Identifier: MIT
// The second derivative of the static energy of FibreSet. For a segment of length l along u with tension T, by the difference
// of its ends:
//   T/l (I - u u^T) + dT/dl u u^T,     dT/dl = F0 / l0 (a fl' + fp')
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
            const double l = length(p), lam = l / l0;
            Mat3 block = Mat3::Zero();
            if (l > 0 && (a != 0 || lam > 1)) {
                double along =
                    fibre.f0_n / l0 * (a * curves_.active_slope(lam) + curves_.passive_slope(lam));
                double across =
                    fibre.f0_n / l * (a * curves_.active(lam).force + curves_.passive(lam).force);
                if (curvature == solve::Curvature::kPositive) {
                    along = std::max(along, 0.0);
                    across = std::max(across, 0.0);
                }
                const solve::Lanes d = position_[p + 1] - position_[p];
                const Vec3 u = Vec3(d[0], d[1], d[2]) / l;
                block = across * Mat3::Identity() + (along - across) * u * u.transpose();
            }
            for (int i = 0; i < count; ++i)
                for (int j = 0; j <= i; ++j) hessian.add(node[i], node[j], c[i] * c[j] * block);
        }
    }
}

}  // namespace risorius::muscle
