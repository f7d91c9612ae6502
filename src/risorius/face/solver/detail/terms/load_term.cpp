// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/terms/load_term.h"

namespace risorius::face {

namespace {

class LocalLoads : public LocalTerm {
  public:
    explicit LocalLoads(const tissue::DeadLoads& whole) : whole_(whole) {}
    void begin(const LocalNodes& nodes, const LocalStep&, const Points&) override {
        std::vector<tissue::DeadLoads::Load> loads;
        for (const tissue::DeadLoads::Load& load : whole_.list())
            if (nodes.moves(load.node)) loads.push_back({nodes.row(load.node), load.force_n});
        loads_.set(std::move(loads));
    }
    void add_energy(const Points& at, double& value, Points& gradient) const override {
        value += loads_.add_energy(at, gradient);
    }

  private:
    const tissue::DeadLoads& whole_;
    tissue::DeadLoads loads_;
};

}  // namespace

double LoadTerm::add_potential(const solve::ImplicitStep&, const Points& x,
                               Points& gradient) const {
    return loads_.add_energy(x, gradient);
}

void LoadTerm::set_boundary_conditions(const BoundaryState& boundary) {
    const double pressure = boundary.mouth_pressure_pa;
    std::vector<tissue::DeadLoads::Load> loads;
    if (pressure != 0)
        for (const auto& [node, area] : cheeks_) loads.push_back({node, pressure * area});
    if (!boundary.weight_m_s2.isZero(0.0))
        for (int i = 0; i < static_cast<int>(mass_kg_.size()); ++i)
            if (!fixed_[static_cast<std::size_t>(i)])
                loads.push_back({i, mass_kg_[i] * boundary.weight_m_s2});
    loads_.set(std::move(loads));
}

std::unique_ptr<LocalTerm> LoadTerm::restricted_to(LocalNodes&) const {
    return std::make_unique<LocalLoads>(loads_);
}

}  // namespace risorius::face
