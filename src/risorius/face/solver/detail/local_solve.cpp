// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/local_solve.h"

#include <algorithm>

#include "risorius/solve/metric_builder.h"

namespace risorius::face {

LocalSolve::LocalSolve(const FaceTerms& terms, const std::vector<char>& moves, const Points& rest,
                       const Eigen::VectorXd& mass_kg, double h)
    : h_(h), nodes_(moves) {
    for (const FaceTerms::Entry& entry : terms.list()) {
        terms_.push_back(entry.face_term ? entry.face_term->restricted_to(nodes_) : nullptr);
        if (!terms_.back()) whole_terms_.push_back(entry.term.get());
    }
    const Points local_rest = taken(rest);
    for (const std::unique_ptr<LocalTerm>& term : terms_)
        if (term) term->build(nodes_, local_rest);
    const int count = nodes_.count();
    mass_kg_.resize(count);
    for (int i = 0; i < count; ++i) mass_kg_[i] = mass_kg[nodes()[static_cast<std::size_t>(i)]];

    solve::MetricBuilder builder(count);
    for (const std::size_t i : terms.order_of_matrices()) {
        if (terms_[i])
            terms_[i]->add_metric(nodes_, h_, builder);
        else
            add_whole_metric(*terms.list()[i].term, builder);
    }
    for (int i = 0; i < count; ++i) builder.add_diagonal(i, mass_kg_[i] / (h_ * h_) + 1e-9);
    std::vector<char> held_rows(static_cast<std::size_t>(count), 1);
    std::fill_n(held_rows.begin(), nodes_.moving(), 0);
    metric_.emplace(builder.build(held_rows), solve::Precision::kSingle);
}

void LocalSolve::add_whole_metric(const solve::EnergyTerm& term,
                                  solve::MetricBuilder& builder) const {
    solve::MetricBuilder whole(static_cast<int>(nodes_.rows().size()));
    term.add_metric(h_, whole);
    const Eigen::SparseMatrix<double> matrix = whole.build({});
    for (int column = 0; column < matrix.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it) {
            const auto row = static_cast<int>(it.row());
            if (!nodes_.moves(row) || !nodes_.moves(column)) continue;
            const int nodes[2] = {nodes_.row(row), nodes_.row(column)};
            const double block[4] = {0, 0, it.value(), 0};
            if (row == column)
                builder.add_diagonal(nodes[0], it.value());
            else
                builder.add_block(nodes, block, 2);
        }
}

double LocalSolve::add_whole_potential(const Points& at, Points& gradient) const {
    for (int i = 0; i < nodes_.moving(); ++i)
        whole_x_.row(nodes()[static_cast<std::size_t>(i)]) = at.row(i);
    whole_gradient_.setZero(whole_x_.rows(), 3);
    double sum = 0;
    for (const solve::EnergyTerm* term : whole_terms_)
        sum += term->add_potential({0.0, h_, whole_start_}, whole_x_, whole_gradient_);
    for (int i = 0; i < nodes_.moving(); ++i)
        gradient.row(i) += whole_gradient_.row(nodes()[static_cast<std::size_t>(i)]);
    return sum;
}

void LocalSolve::begin(const LocalStep& step, const Points& x) {
    aim_ = taken(step.aim);
    if (!whole_terms_.empty()) {
        whole_start_ = step.start;
        whole_x_ = x;
    }
    for (const std::unique_ptr<LocalTerm>& term : terms_)
        if (term) term->begin(nodes_, step, x);
}

double LocalSolve::energy(const Points& at, Points& gradient) const {
    const double inertia = 1.0 / (h_ * h_);
    double value = 0;
    gradient.setZero(at.rows(), 3);
    for (long i = 0; i < nodes_.moving(); ++i) {
        const Vec3 off = (at.row(i) - aim_.row(i)).transpose();
        value += 0.5 * inertia * mass_kg_[i] * off.squaredNorm();
        gradient.row(i) = inertia * mass_kg_[i] * off.transpose();
    }
    for (const std::unique_ptr<LocalTerm>& term : terms_)
        if (term) term->add_energy(at, value, gradient);
    if (!whole_terms_.empty()) value += add_whole_potential(at, gradient);
    gradient.bottomRows(gradient.rows() - nodes_.moving()).setZero();
    return value;
}

solve::StepReport LocalSolve::advance(const LocalStep& step,
                                      const solve::QuasiNewtonOptions& options, Points& x) {
    begin(step, x);
    x_ = taken(x);
    const solve::StepReport report =
        newton_.minimise([&](const Points& at, Points& gradient) { return energy(at, gradient); },
                         *metric_, x_, options);
    for (int i = 0; i < nodes_.moving(); ++i)
        x.row(nodes()[static_cast<std::size_t>(i)]) = x_.row(i);
    return report;
}

}  // namespace risorius::face
