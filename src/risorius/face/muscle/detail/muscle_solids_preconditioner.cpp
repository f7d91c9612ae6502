// SPDX-License-Identifier: MIT
// The preconditioner of a step: volume muscles that share nodes form a group with a factor of its own, which is kept while they hardly
// move.
#include <algorithm>
#include <cmath>

#include "risorius/face/muscle/detail/muscle_solids.h"

namespace risorius::face {

namespace {

constexpr double kRefreshMove_m = 1e-3,
                 kRefreshActivation = 0.15;  // changes after which H is factored again

}  // namespace

void MuscleSolids::forget() {
    for (Group& group : groups_) group.made.for_s = 0;
}

std::vector<MuscleSolids::Factorised> MuscleSolids::factorised() const {
    std::vector<Factorised> all;
    for (const Group& group : groups_) all.push_back(group.made);
    return all;
}

void MuscleSolids::go_back_to(const std::vector<Factorised>& factorised) {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        Group& group = groups_[g];
        const Factorised& made = factorised[g];
        if (made.for_s == 0) {
            group.made.for_s = 0;
            continue;
        }
        set_bodies({Rigid::Identity(), made.mandible});
        Points x = Points::Zero(first_ + nodes(), 3);
        for (std::size_t i = 0; i < group.node.size(); ++i)
            x.row(first_ + group.node[i]) = made.at.row(static_cast<long>(i));
        int columns = 0;
        for (const Part& part : parts_) columns = std::max(columns, part.place().column + 1);
        Eigen::VectorXd activation = Eigen::VectorXd::Zero(columns);
        for (std::size_t p = 0; p < group.part.size(); ++p) {
            Part& part = parts_[static_cast<std::size_t>(group.part[p])];
            activation[part.place().column] = made.with[p];
            take(part, x, part.x);
            part.belly->begin_step(made.for_s, part.x);
        }
        refresh(group, made.for_s, x, activation);
    }
}

void MuscleSolids::begin_step(double h, const Points& x, const Eigen::VectorXd& activation) {
    if (empty()) return;
    for (Part& part : parts_) {
        take(part, x, part.x);
        part.belly->begin_step(h, part.x);
    }
    for (Group& group : groups_) {
        bool known = group.made.for_s == h;
        for (std::size_t p = 0; known && p < group.part.size(); ++p)
            known = std::abs(
                        activation[parts_[static_cast<std::size_t>(group.part[p])].place().column] -
                        group.made.with[p]) < kRefreshActivation;
        for (std::size_t i = 0; known && i < group.node.size(); ++i)
            known = (x.row(first_ + group.node[i]) - group.made.at.row(static_cast<long>(i)))
                        .squaredNorm() < kRefreshMove_m * kRefreshMove_m;
        if (!known) refresh(group, h, x, activation);
    }
}

void MuscleSolids::build_groups() {
    std::vector<int> group_of_node(static_cast<std::size_t>(nodes()), -1);
    row_.assign(static_cast<std::size_t>(nodes()), 0);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        int which = -1;
        for (int node : parts_[p].place().node)
            which = std::max(which, group_of_node[static_cast<std::size_t>(node)]);
        if (which < 0) {
            which = static_cast<int>(groups_.size());
            groups_.emplace_back();
        }
        Group& group = groups_[static_cast<std::size_t>(which)];
        group.part.push_back(static_cast<int>(p));
        group.row.emplace_back();
        for (int node : parts_[p].place().node) {
            if (group_of_node[static_cast<std::size_t>(node)] < 0) {
                group_of_node[static_cast<std::size_t>(node)] = which;
                row_[static_cast<std::size_t>(node)] = static_cast<int>(group.node.size());
                group.node.push_back(node);
            }
            group.row.back().push_back(row_[static_cast<std::size_t>(node)]);
        }
    }
    for (std::size_t i = 0; i < bindings_.size(); ++i)
        groups_[static_cast<std::size_t>(
                    group_of_node[static_cast<std::size_t>(bindings_[i].solid[0])])]
            .binding.push_back(i);
    for (std::size_t i = 0; i < support_node_.size(); ++i)
        groups_[static_cast<std::size_t>(group_of_node[static_cast<std::size_t>(support_node_[i])])]
            .support.push_back(i);
    for (Group& group : groups_) {
        std::vector<char> fixed;
        for (int node : group.node) fixed.push_back(on_bone(node) ? 1 : 0);
        group.hessian =
            std::make_unique<solve::HessianBuilder>(static_cast<int>(group.node.size()), fixed);
        group.made.with.resize(group.part.size());
        group.b.resize(3 * group.node.size());
        group.y.resize(3 * group.node.size());
    }
}

void MuscleSolids::refresh(Group& group, double h, const Points& x,
                           const Eigen::VectorXd& activation) {
    group.made.for_s = h;
    group.made.mandible = mandible_;
    group.made.at.resize(static_cast<long>(group.node.size()), 3);
    for (std::size_t i = 0; i < group.node.size(); ++i)
        group.made.at.row(static_cast<long>(i)) = x.row(first_ + group.node[i]);
    solve::HessianBuilder& hessian = *group.hessian;
    hessian.clear();
    for (std::size_t p = 0; p < group.part.size(); ++p) {
        Part& part = parts_[static_cast<std::size_t>(group.part[p])];
        const std::vector<int>& row = group.row[p];
        const double a = group.made.with[p] = activation[part.place().column];
        take(part, x, part.x);
        part.belly->add_stiffness(part.x, a, row, hessian);
    }
    const auto row_of = [&](int node) { return row_[static_cast<std::size_t>(node)]; };
    for (std::size_t i : group.binding) {
        const Binding& binding = bindings_[i];
        for (int a = 0; a < binding.solid_count; ++a)
            for (int b = 0; b <= a; ++b)
                hessian.add(row_of(binding.solid[a]), row_of(binding.solid[b]),
                            binding.stiffness_n_per_m * binding.solid_weight[a] *
                                binding.solid_weight[b] * Mat3::Identity());
    }
    for (std::size_t i : group.support) {
        const tissue::ZeroLengthSprings::Spring& support = supports_->list()[i];
        hessian.add(row_of(support_node_[i]), row_of(support_node_[i]),
                    support.kn_n_per_m * support.normal * support.normal.transpose());
    }
    for (int node : group.node) hessian.add_diagonal(row_of(node), mass_[node] / (h * h) + 1e-6);
    group.factor.factorise(hessian.build(), 3);
}

void MuscleSolids::solve_solids() const {
    for (const Group& group : groups_) {
        for (std::size_t i = 0; i < group.node.size(); ++i)
            for (int k = 0; k < 3; ++k)
                group.b[3 * i + static_cast<std::size_t>(k)] = solid_b_(group.node[i], k);
        group.factor.solve(group.b.data(), group.y.data(), 1);
        for (std::size_t i = 0; i < group.node.size(); ++i)
            for (int k = 0; k < 3; ++k)
                solid_y_(group.node[i], k) = group.y[3 * i + static_cast<std::size_t>(k)];
    }
}

void MuscleSolids::precondition(const solve::SparseCholesky& tissue, const Points& b,
                                Points& y) const {
    if (empty()) {
        tissue.solve(b, y);
        return;
    }
    const long tissue_rows = first_;
    solid_b_ = b.bottomRows(nodes());
    solid_y_.resize(nodes(), 3);
    solve_solids();
    tissue_b_ = b.topRows(tissue_rows);
    for (const Binding& binding : bindings_) {
        Vec3 moved = Vec3::Zero();
        for (int k = 0; k < binding.solid_count; ++k)
            moved += binding.solid_weight[k] * solid_y_.row(binding.solid[k]).transpose();
        for (int k = 0; k < binding.tissue_count; ++k)
            tissue_b_.row(binding.tissue[k]) +=
                binding.stiffness_n_per_m * binding.tissue_weight[k] * moved.transpose();
    }
    for (int node : held_tissue_) tissue_b_.row(node).setZero();
    tissue.solve(tissue_b_, tissue_y_);
    for (const Binding& binding : bindings_) {
        Vec3 moved = Vec3::Zero();
        for (int k = 0; k < binding.tissue_count; ++k)
            moved += binding.tissue_weight[k] * tissue_y_.row(binding.tissue[k]).transpose();
        for (int k = 0; k < binding.solid_count; ++k)
            solid_b_.row(binding.solid[k]) +=
                binding.stiffness_n_per_m * binding.solid_weight[k] * moved.transpose();
    }
    for (int i = 0; i < nodes(); ++i)
        if (on_bone(i)) solid_b_.row(i).setZero();
    solve_solids();
    y.resize(b.rows(), 3);
    y.topRows(tissue_rows) = tissue_y_;
    y.bottomRows(nodes()) = solid_y_;
}

}  // namespace risorius::face
