// SPDX-License-Identifier: MIT
// The second derivative of the static energy of the volume muscles, over all unknowns of a face.
#include <limits>

#include "risorius/face/muscle/detail/muscle_solids.h"
#include "risorius/solve/energy_term.h"

namespace risorius::face {

void MuscleSolids::begin_rest(const Points& x) {
    step_s_ = std::numeric_limits<double>::infinity();
    for (Part& part : parts_) take(part, x, part.start);
}

void MuscleSolids::add_hessian(const Points& x, const Eigen::VectorXd& activation,
                               solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    for (const Part& part : parts_) {
        take(part, x, part.x);
        std::vector<int> row;
        for (int node : part.place.node) row.push_back(first_ + node);
        part.hessian->clear();
        part.cells->add_hessian({0.0, step_s_, part.start}, part.x, curvature, *part.hessian);
        const solve::SymmetricBlocks& blocks = part.hessian->build_blocks();
        for (int column = 0; column < blocks.nodes(); ++column)
            for (int i = blocks.begin[static_cast<std::size_t>(column)];
                 i < blocks.begin[static_cast<std::size_t>(column) + 1]; ++i)
                hessian.add(row[static_cast<std::size_t>(blocks.row[static_cast<std::size_t>(i)])],
                            row[static_cast<std::size_t>(column)],
                            blocks.value[static_cast<std::size_t>(i)]);
        part.chains->add_hessian(part.x, activation[part.place.column], curvature, row, hessian);
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
