// SPDX-License-Identifier: MIT
#include "risorius/solve/part_term.h"

#include <utility>

namespace risorius::solve {

PartTerm::PartTerm(std::shared_ptr<EnergyTerm> term, int first, int count)
    : term_(std::move(term)), first_(first), count_(count), hessian_(count, {}) {}

void PartTerm::begin_step(double t_s, double step_s, const Points& x, const Points& v) {
    x_ = x.middleRows(first_, count_);
    v_ = v.middleRows(first_, count_);
    term_->begin_step(t_s, step_s, x_, v_);
}

void PartTerm::add_force(double t_s, const Points& x, const Points& v, Points& force) const {
    x_ = x.middleRows(first_, count_);
    v_ = v.middleRows(first_, count_);
    out_.setZero(count_, 3);
    term_->add_force(t_s, x_, v_, out_);
    force.middleRows(first_, count_) += out_;
}

double PartTerm::energy(double t_s, const Points& x) const {
    x_ = x.middleRows(first_, count_);
    return term_->energy(t_s, x_);
}

double PartTerm::add_potential(const ImplicitStep& step, const Points& x, Points& gradient) const {
    x_ = x.middleRows(first_, count_);
    start_ = step.start.middleRows(first_, count_);
    out_.setZero(count_, 3);
    const double potential = term_->add_potential({step.end_s, step.step_s, start_}, x_, out_);
    gradient.middleRows(first_, count_) += out_;
    return potential;
}

void PartTerm::add_hessian(const ImplicitStep& step, const Points& x, Curvature curvature,
                           HessianBuilder& hessian) const {
    x_ = x.middleRows(first_, count_);
    start_ = step.start.middleRows(first_, count_);
    hessian_.clear();
    term_->add_hessian({step.end_s, step.step_s, start_}, x_, curvature, hessian_);
    const SymmetricBlocks& blocks = hessian_.build_blocks();
    for (int column = 0; column < count_; ++column)
        for (int i = blocks.begin[column]; i < blocks.begin[column + 1]; ++i)
            hessian.add(first_ + blocks.row[i], first_ + column, blocks.value[i]);
}

void PartTerm::copy_to(MetricBuilder& part, MetricBuilder& whole) const {
    const Eigen::SparseMatrix<double> matrix = part.build({});
    for (int column = 0; column < matrix.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it) {
            const int nodes[2] = {first_ + static_cast<int>(it.row()), first_ + column};
            const double block[4] = {0, 0, it.value(), 0};
            if (it.row() == column)
                whole.add_diagonal(nodes[0], it.value());
            else
                whole.add_block(nodes, block, 2);
        }
}

void PartTerm::add_metric(double step_s, MetricBuilder& metric) const {
    MetricBuilder part(count_);
    term_->add_metric(step_s, part);
    copy_to(part, metric);
}

void PartTerm::add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                          MetricBuilder& K, MetricBuilder& damping, Points& force) const {
    x_ = x.middleRows(first_, count_);
    v_ = v.middleRows(first_, count_);
    out_.setZero(count_, 3);
    MetricBuilder part_K(count_), part_damping(count_);
    term_->add_secant(t_s, x_, v_, lag_rate, part_K, part_damping, out_);
    copy_to(part_K, K);
    copy_to(part_damping, damping);
    force.middleRows(first_, count_) += out_;
}

}  // namespace risorius::solve
