// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/terms/tissue_term.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace risorius::face {

namespace {

// All tetrahedra with a moving node, and those that keep their volume together with them.
class LocalTissue : public LocalTerm {
  public:
    LocalTissue(const tissue::TetSolid& whole, double damping_s, LocalNodes& nodes)
        : damping_s_(damping_s) {
        const Tets& all = whole.tets();
        const tissue::TetFans fans = whole.fans();
        const auto move = [&](const auto& some) {
            return std::any_of(some.begin(), some.end(), [&](int n) { return nodes.moves(n); });
        };
        std::vector<int> rows;
        for (tissue::TetFan fan : fans.fans) {
            if (!move(fan.nodes)) continue;
            for (int& tet : fan.tets) {
                rows.push_back(tet);
                tet = static_cast<int>(rows.size()) - 1;
            }
            for (int& node : fan.nodes) node = nodes.add(node);
            fans_.fans.push_back(fan);
        }
        for (const int tet : fans.alone)
            if (move(all.row(tet))) {
                fans_.alone.push_back(static_cast<int>(rows.size()));
                rows.push_back(tet);
            }
        tets_.resize(static_cast<long>(rows.size()), 4);
        mu_.resize(tets_.rows());
        bulk_.resize(tets_.rows());
        for (long t = 0; t < tets_.rows(); ++t) {
            const int of = rows[static_cast<std::size_t>(t)];
            for (int k = 0; k < 4; ++k) tets_(t, k) = nodes.add(all(of, k));
            mu_[t] = whole.mu_pa()[of];
            bulk_[t] = whole.bulk_pa()[of];
        }
    }
    void build(const LocalNodes&, const Points& rest) override {
        solid_.emplace(tets_, rest, mu_, bulk_, fans_);
    }
    void add_metric(const LocalNodes&, double h, solve::MetricBuilder& builder) const override {
        solid_->add_metric(builder);
        solid_->add_laplacian(builder, damping_s_ / h);
    }
    void begin(const LocalNodes& nodes, const LocalStep& step, const Points&) override {
        precision_ = step.precision;
        solid_->begin_step(nodes.taken(step.start), damping_s_ / step.h, step.precision);
    }
    void add_energy(const Points& at, double& value, Points& gradient) const override {
        value += solid_->add_step_energy(at, gradient, precision_);
    }

  private:
    double damping_s_;
    Tets tets_;
    tissue::TetFans fans_;
    Eigen::VectorXd mu_, bulk_;
    std::optional<tissue::TetSolid> solid_;
    solve::Precision precision_ = solve::Precision::kDouble;
};

}  // namespace

void TissueTerm::begin_step(double, double step_s, const Points& x, const Points&) {
    tets_.begin_step(x, damping_s_ / step_s, inputs_.precision);
}

double TissueTerm::add_potential(const solve::ImplicitStep& step, const Points& x,
                                 Points& gradient) const {
    return in_equilibrium(step) ? tets_.add_energy(x, gradient)
                                : tets_.add_step_energy(x, gradient, inputs_.precision);
}

void TissueTerm::add_hessian(const solve::ImplicitStep&, const Points& x,
                             solve::Curvature curvature, solve::HessianBuilder& hessian) const {
    tets_.add_hessian(x, curvature, hessian);
}

void TissueTerm::add_metric(double step_s, solve::MetricBuilder& metric) const {
    tets_.add_metric(metric);
    tets_.add_laplacian(metric, damping_s_ / step_s);
}

std::unique_ptr<LocalTerm> TissueTerm::restricted_to(LocalNodes& nodes) const {
    return std::make_unique<LocalTissue>(tets_, damping_s_, nodes);
}

}  // namespace risorius::face
