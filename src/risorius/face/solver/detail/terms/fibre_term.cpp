// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/terms/fibre_term.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "risorius/face/muscle/detail/muscle_placement.h"

namespace risorius::face {

namespace {

// The runs of segments that have a moving end.
class LocalFibres : public LocalTerm {
  public:
    LocalFibres(const muscle::FibreSet& whole, const muscle::HillShape& hill, LocalNodes& nodes)
        : whole_(whole), hill_(hill) {
        for (const muscle::Fibre& fibre : whole.fibres()) {
            const auto moved_by = [&](int p) {
                const muscle::FibrePoint& point = whole.points()[static_cast<std::size_t>(p)];
                for (int i = 0; i < point.count; ++i)
                    if (nodes.moves(point.nodes[i])) return true;
                return false;
            };
            const int f = static_cast<int>(&fibre - whole.fibres().data());
            const int end = fibre.first_point + fibre.point_count - 1;
            for (int p = fibre.first_point; p < end; ++p) {
                if (!moved_by(p) && !moved_by(p + 1)) continue;
                if (point_of_.empty() || point_of_.back() != p || fibre_of_.back() != f) {
                    fibre_of_.push_back(f);
                    point_of_.push_back(p);
                    first_point_.push_back(static_cast<int>(point_of_.size()) - 1);
                }
                point_of_.push_back(p + 1);
            }
        }
        for (const int p : point_of_) {
            const muscle::FibrePoint& point = whole.points()[static_cast<std::size_t>(p)];
            for (int i = 0; i < point.count; ++i) nodes.add(point.nodes[i]);
        }
    }
    void build(const LocalNodes& nodes, const Points& rest) override {
        std::vector<muscle::FibrePoint> points;
        for (const int p : point_of_) {
            muscle::FibrePoint point = whole_.points()[static_cast<std::size_t>(p)];
            for (int i = 0; i < point.count; ++i) point.nodes[i] = nodes.row(point.nodes[i]);
            points.push_back(point);
        }
        std::vector<muscle::Fibre> fibres;
        for (std::size_t f = 0; f < fibre_of_.size(); ++f) {
            muscle::Fibre fibre = whole_.fibres()[static_cast<std::size_t>(fibre_of_[f])];
            const int end = f + 1 < first_point_.size() ? first_point_[f + 1]
                                                        : static_cast<int>(point_of_.size());
            fibre.first_point = first_point_[f];
            fibre.point_count = end - first_point_[f];
            fibres.push_back(fibre);
        }
        fibres_.emplace(std::move(points), std::move(fibres), rest, hill_);
    }
    void add_metric(const LocalNodes&, double h, solve::MetricBuilder& builder) const override {
        fibres_->add_metric(builder, h);
    }
    void begin(const LocalNodes&, const LocalStep& step, const Points&) override {
        activation_ = step.activation;
        fibres_->go_on(whole_, fibre_of_, point_of_);
    }
    void add_energy(const Points& at, double& value, Points& gradient) const override {
        value += fibres_->add_energy(at, activation_, gradient);
    }

  private:
    const muscle::FibreSet& whole_;
    const muscle::HillShape& hill_;
    std::vector<int> fibre_of_, point_of_;  // numbers in the whole
    std::vector<int> first_point_;          // of each fibre here
    std::optional<muscle::FibreSet> fibres_;
    Eigen::VectorXd activation_;
};

}  // namespace

double FibreTerm::add_potential(const solve::ImplicitStep&, const Points& x,
                                Points& gradient) const {
    return fibres_.add_energy(x, *inputs_.activation, gradient);
}

void FibreTerm::add_hessian(const solve::ImplicitStep&, const Points& x, solve::Curvature curvature,
                            solve::HessianBuilder& hessian) const {
    fibres_.add_hessian(x, *inputs_.activation, curvature, hessian);
}

void FibreTerm::add_metric(double step_s, solve::MetricBuilder& metric) const {
    fibres_.add_metric(metric, step_s < kSettling_s ? step_s : 0);
}

void FibreTerm::set_boundary_conditions(const BoundaryState& boundary) {
    move_mandible(boundary.mandible);
}

void FibreTerm::move_mandible(const Rigid& mandible) {
    const std::array<Rigid, kBodies> bodies{Rigid::Identity(), mandible};
    fibres_.set_body_positions(bodies);
}

void FibreTerm::add_mandible_gradient(const Rigid& mandible, const Points&, const Points&,
                                      Wrench& sum) const {
    for (std::size_t p = 0; p < fibres_.points().size(); ++p) {
        const muscle::FibrePoint& point = fibres_.points()[p];
        if (point.count == 0 && point.body == kMandibleBody)
            sum.add(fibres_.point_gradient(static_cast<int>(p)), mandible * point.body_rest);
    }
}

std::unique_ptr<LocalTerm> FibreTerm::restricted_to(LocalNodes& nodes) const {
    return std::make_unique<LocalFibres>(fibres_, hill_, nodes);
}

}  // namespace risorius::face
