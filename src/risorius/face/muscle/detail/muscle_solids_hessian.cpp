// SPDX-License-Identifier: MIT
// The second derivative of the static energy of the volume muscles, over all unknowns of a face.
#include <limits>

#include "risorius/face/muscle/detail/muscle_solids.h"
#include "risorius/solve/energy_term.h"

namespace risorius::face {

void MuscleSolids::begin_rest(const Points& x) {
    for (Part& part : parts_) {
        take(part, x, part.x);
        part.belly->begin_step(std::numeric_limits<double>::infinity(), part.x);
    }
}

void MuscleSolids::add_hessian(const Points& x, const Eigen::VectorXd& activation,
                               solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    for (const Part& part : parts_) {
        take(part, x, part.x);
        std::vector<int> row;
        for (int node : part.place().node) row.push_back(first_ + node);
        part.belly->add_hessian(part.x, activation[part.place().column], curvature, row, hessian);
    }
    for (const Binding& binding : bindings_) {
        int node[12];
        double c[12];
        int count = 0;
        for (int k = 0; k < binding.tissue_count; ++k) {
            node[count] = binding.tissue[k];
            c[count++] = binding.tissue_weight[k];
        }
        for (int k = 0; k < binding.solid_count; ++k) {
            node[count] = first_ + binding.solid[k];
            c[count++] = -binding.solid_weight[k];
        }
        for (int a = 0; a < count; ++a)
            for (int b = 0; b <= a; ++b)
                hessian.add(node[a], node[b],
                            binding.stiffness_n_per_m * c[a] * c[b] * Mat3::Identity());
    }
    if (supports_) supports_->add_hessian(hessian);
}

}  // namespace risorius::face
