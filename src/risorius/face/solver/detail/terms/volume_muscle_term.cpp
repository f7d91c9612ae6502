// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/terms/volume_muscle_term.h"

#include <array>
#include <vector>

namespace risorius::face {

namespace {

// The springs between the tissue and the muscles, which do not move here.
class LocalBindings : public LocalTerm {
  public:
    explicit LocalBindings(const MuscleSolids& solids) : solids_(solids) {}
    void begin(const LocalNodes& nodes, const LocalStep&, const Points& x) override {
        springs_.clear();
        solids_.add_springs(x, springs_);
        std::size_t kept = 0;
        for (const MuscleSolids::Spring& found : springs_) {
            MuscleSolids::Spring spring = found;
            spring.count = 0;
            for (int i = 0; i < found.count; ++i) {
                if (nodes.moves(found.nodes[i])) {
                    spring.nodes[spring.count] = nodes.row(found.nodes[i]);
                    spring.weights[spring.count++] = found.weights[i];
                } else {
                    spring.target -= found.weights[i] * x.row(found.nodes[i]).transpose();
                }
            }
            if (spring.count > 0) springs_[kept++] = spring;
        }
        springs_.resize(kept);
    }
    void add_energy(const Points& at, double& value, Points& gradient) const override {
        for (const MuscleSolids::Spring& spring : springs_) {
            Vec3 off = -spring.target;
            for (int i = 0; i < spring.count; ++i)
                off += spring.weights[i] * at.row(spring.nodes[i]).transpose();
            value += 0.5 * spring.stiffness_n_per_m * off.squaredNorm();
            for (int i = 0; i < spring.count; ++i)
                gradient.row(spring.nodes[i]) +=
                    spring.stiffness_n_per_m * spring.weights[i] * off.transpose();
        }
    }

  private:
    const MuscleSolids& solids_;
    std::vector<MuscleSolids::Spring> springs_;
};

}  // namespace

void VolumeMuscleTerm::begin_step(double, double step_s, const Points& x, const Points&) {
    solids_.begin_step(step_s, x, *inputs_.activation);
}

double VolumeMuscleTerm::add_potential(const solve::ImplicitStep&, const Points& x,
                                       Points& gradient) const {
    pull_ = {};
    return inputs_.solids_relaxed ? 0.0
                                  : solids_.add_energy(x, *inputs_.activation, gradient, &pull_);
}

void VolumeMuscleTerm::add_hessian(const solve::ImplicitStep&, const Points& x,
                                   solve::Curvature curvature,
                                   solve::HessianBuilder& hessian) const {
    solids_.add_hessian(x, *inputs_.activation, curvature, hessian);
}

void VolumeMuscleTerm::add_metric(double, solve::MetricBuilder& metric) const {
    solids_.add_metric(metric);
}

void VolumeMuscleTerm::set_boundary_conditions(const BoundaryState& boundary) {
    solids_.set_bodies({Rigid::Identity(), boundary.mandible});
}

void VolumeMuscleTerm::move_mandible(const Rigid& mandible) {
    solids_.move_bodies({Rigid::Identity(), mandible});
}

void VolumeMuscleTerm::carry(Points& x, const Rigid& from, const Rigid& to) const {
    solids_.carry(x, from, to);
}

void VolumeMuscleTerm::add_mandible_gradient(const Rigid& mandible, const Points&,
                                             const Points& gradient, Wrench& sum) const {
    solids_.add_riding(mandible, gradient, sum);
    sum.force_n -= pull_[kMandibleBody].force_n;
    sum.torque_nm -= pull_[kMandibleBody].torque_nm;
}

std::unique_ptr<LocalTerm> VolumeMuscleTerm::restricted_to(LocalNodes&) const {
    return std::make_unique<LocalBindings>(solids_);
}

}  // namespace risorius::face
