// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/terms/skin_term.h"

#include <optional>
#include <vector>

namespace risorius::face {

namespace {

// All triangles with a moving node, and their neighbours: a hinge reaches across an edge.
class LocalSkin : public LocalTerm {
  public:
    LocalSkin(const SkinSheetParts& whole, LocalNodes& nodes) {
        const Triangles& all = whole.triangles;
        std::vector<char> near(nodes.rows().size(), 0);
        for (int f = 0; f < static_cast<int>(all.rows()); ++f) {
            bool any = false;
            for (int k = 0; k < 3; ++k) any = any || nodes.moves(all(f, k));
            if (!any) continue;
            for (int k = 0; k < 3; ++k) near[static_cast<std::size_t>(all(f, k))] = 1;
        }
        std::vector<int> rows;
        for (int f = 0; f < static_cast<int>(all.rows()); ++f) {
            int count = 0;
            for (int k = 0; k < 3; ++k) count += near[static_cast<std::size_t>(all(f, k))];
            if (count >= 2) rows.push_back(f);
        }
        parts_.triangles.resize(static_cast<long>(rows.size()), 3);
        parts_.membrane_n_per_m.resize(parts_.triangles.rows());
        parts_.bending_n_m.resize(parts_.triangles.rows());
        for (long f = 0; f < parts_.triangles.rows(); ++f) {
            const int of = rows[static_cast<std::size_t>(f)];
            for (int k = 0; k < 3; ++k) parts_.triangles(f, k) = nodes.add(all(of, k));
            parts_.membrane_n_per_m[f] = whole.membrane_n_per_m[of];
            parts_.bending_n_m[f] = whole.bending_n_m[of];
        }
    }
    void build(const LocalNodes&, const Points& rest) override {
        sheet_.emplace(parts_.triangles, rest, parts_.membrane_n_per_m, parts_.bending_n_m);
    }
    void add_metric(const LocalNodes&, double, solve::MetricBuilder& builder) const override {
        sheet_->add_metric(builder);
    }
    void begin(const LocalNodes&, const LocalStep& step, const Points&) override {
        precision_ = step.precision;
    }
    void add_energy(const Points& at, double& value, Points& gradient) const override {
        value += sheet_->add_energy(at, gradient, precision_);
    }

  private:
    SkinSheetParts parts_;
    std::optional<tissue::SkinSheet> sheet_;
    solve::Precision precision_ = solve::Precision::kDouble;
};

}  // namespace

double SkinTerm::add_potential(const solve::ImplicitStep& step, const Points& x,
                               Points& gradient) const {
    return skin_.add_energy(x, gradient,
                            in_equilibrium(step) ? solve::Precision::kDouble : inputs_.precision);
}

void SkinTerm::add_hessian(const solve::ImplicitStep&, const Points& x, solve::Curvature curvature,
                           solve::HessianBuilder& hessian) const {
    skin_.add_hessian(x, curvature, hessian);
}

void SkinTerm::add_metric(double, solve::MetricBuilder& metric) const { skin_.add_metric(metric); }

std::unique_ptr<LocalTerm> SkinTerm::restricted_to(LocalNodes& nodes) const {
    return std::make_unique<LocalSkin>(parts_, nodes);
}

}  // namespace risorius::face
