// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/face_terms.h"

#include <cmath>
#include <utility>

namespace risorius::face {

bool in_equilibrium(const solve::ImplicitStep& step) { return std::isinf(step.step_s); }

void FaceTerms::add(std::shared_ptr<solve::EnergyTerm> term, TermOrder order) {
    auto* face_term = dynamic_cast<FaceTerm*>(term.get());
    list_.push_back({std::move(term), face_term, order});
}

void FaceTerms::set_boundary_conditions(const BoundaryState& boundary) {
    for (const Entry& entry : list_)
        if (entry.face_term) entry.face_term->set_boundary_conditions(boundary);
}

void FaceTerms::move_mandible(const Rigid& mandible) {
    for (const Entry& entry : list_)
        if (entry.face_term) entry.face_term->move_mandible(mandible);
}

void FaceTerms::carry(Points& x, const Rigid& from, const Rigid& to) const {
    for (const Entry& entry : list_)
        if (entry.face_term) entry.face_term->carry(x, from, to);
}

Wrench FaceTerms::mandible_gradient(const Rigid& mandible, const Points& x,
                                    const Points& gradient) const {
    Wrench sum;
    for (const bool last : {false, true})
        for (const Entry& entry : list_)
            if (entry.face_term && entry.order.last_on_mandible == last)
                entry.face_term->add_mandible_gradient(mandible, x, gradient, sum);
    return sum;
}

void FaceTerms::begin_step(double step_s, const Points& start) {
    for (const Entry& entry : list_) entry.term->begin_step(0.0, step_s, start, {});
}

FaceTerms::Energy FaceTerms::add_potential(const solve::ImplicitStep& step, const Points& x,
                                           Points& gradient) const {
    Energy sum;
    sum.first = list_[0].term->add_potential(step, x, gradient);
    sum.others = list_[1].term->add_potential(step, x, gradient);
    for (std::size_t i = 2; i < list_.size(); ++i)
        sum.others += list_[i].term->add_potential(step, x, gradient);
    return sum;
}

void FaceTerms::add_hessian(const solve::ImplicitStep& step, const Points& x,
                            solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    for (const std::size_t i : order_of_matrices())
        list_[i].term->add_hessian(step, x, curvature, hessian);
}

void FaceTerms::add_metric(double step_s, solve::MetricBuilder& metric) const {
    for (const std::size_t i : order_of_matrices()) list_[i].term->add_metric(step_s, metric);
}

std::vector<std::size_t> FaceTerms::order_of_matrices() const {
    std::vector<std::size_t> order;
    for (const bool changing : {false, true})
        for (std::size_t i = 0; i < list_.size(); ++i)
            if (list_[i].order.changing_pairs == changing) order.push_back(i);
    return order;
}

}  // namespace risorius::face
