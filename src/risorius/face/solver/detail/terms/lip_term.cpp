// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/terms/lip_term.h"

namespace risorius::face {

namespace {

class LocalLips : public LocalTerm {
  public:
    LocalLips(const LipDrive& whole, const LocalNodes& nodes) : whole_(whole), lips_(whole) {
        lips_.keep(nodes.rows(), nodes.moving());
    }
    void add_metric(const LocalNodes&, double, solve::MetricBuilder& builder) const override {
        lips_.add_metric(builder);
    }
    void begin(const LocalNodes& nodes, const LocalStep&, const Points&) override {
        lips_ = whole_;
        lips_.keep(nodes.rows(), nodes.moving());
    }
    void add_energy(const Points& at, double& value, Points& gradient) const override {
        value += lips_.add_energy(at, gradient);
    }

  private:
    const LipDrive& whole_;
    LipDrive lips_;
};

}  // namespace

double LipTerm::add_potential(const solve::ImplicitStep&, const Points& x, Points& gradient) const {
    lips_.drive(*inputs_.activation);
    return lips_.add_energy(x, gradient);
}

void LipTerm::add_hessian(const solve::ImplicitStep&, const Points& x, solve::Curvature,
                          solve::HessianBuilder& hessian) const {
    lips_.drive(*inputs_.activation);
    lips_.add_hessian(x, hessian);
}

void LipTerm::add_metric(double, solve::MetricBuilder& metric) const { lips_.add_metric(metric); }

void LipTerm::set_boundary_conditions(const BoundaryState& boundary) {
    lips_.set_mandible(boundary.mandible);
}

void LipTerm::move_mandible(const Rigid& mandible) { lips_.move_mandible(mandible); }

void LipTerm::add_mandible_gradient(const Rigid&, const Points& x, const Points&,
                                    Wrench& sum) const {
    lips_.add_mandible_gradient(x, sum);
}

std::unique_ptr<LocalTerm> LipTerm::restricted_to(LocalNodes& nodes) const {
    return std::make_unique<LocalLips>(lips_, nodes);
}

}  // namespace risorius::face
