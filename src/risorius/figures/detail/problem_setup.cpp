// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/problem_setup.h"

#include <limits>

#include "risorius/core/error.h"
#include "risorius/solve/newton.h"
#include "risorius/tissue/bending_cells.h"
#include "risorius/tissue/cell_solid.h"

namespace risorius::figures {

namespace {

/// Constant forces as an energy term.
class Loads : public solve::EnergyTerm {
  public:
    explicit Loads(const std::vector<tissue::DeadLoads::Load>& loads) { loads_.set(loads); }
    double add_potential(const solve::ImplicitStep&, const Points& x,
                         Points& gradient) const override {
        return loads_.add_energy(x, gradient);
    }
    void add_hessian(const solve::ImplicitStep&, const Points&, solve::Curvature,
                     solve::HessianBuilder&) const override {}
    void add_metric(double, solve::MetricBuilder&) const override {}

  private:
    tissue::DeadLoads loads_;
};

}  // namespace

ProblemSetup::ProblemSetup(const tissue::GridShape& grid, const tissue::RestShape& rest,
                           const KnownMaterial& material)
    : body(tissue::cell_body(tissue::uniform_cells(grid), rest, material.moduli(), 1)),
      fixed(static_cast<std::size_t>(grid.size()), 0),
      x(body.rest) {
    if (material.bending_cells)
        solid = std::make_shared<tissue::BendingCells>(body);
    else
        solid = std::make_shared<tissue::CellSolid>(body);
    const double size = (rest({1, 1, 1}) - rest({0, 0, 0})).cwiseAbs().maxCoeff();
    guide_n_per_m_ = 1e6 * material.young_pa * size;
}

void ProblemSetup::load_plane(const tissue::GridShape& grid, int plane, const Vec3& force) {
    const double cells = (grid.n - 1.0) * (grid.o - 1.0);
    for (int n = 0; n < grid.n; ++n)
        for (int o = 0; o < grid.o; ++o) {
            const double share = (n == 0 || n == grid.n - 1 ? 0.5 : 1) *
                                 (o == 0 || o == grid.o - 1 ? 0.5 : 1) / cells;
            loads.push_back({grid.index(plane, n, o), share * force});
        }
}

void ProblemSetup::settle() {
    const long n = x.rows();
    solve::MotionSystem system(Eigen::VectorXd::Ones(n), fixed);
    system.add(solid);
    system.add(std::make_shared<Loads>(loads));
    system.add(std::make_shared<tissue::CoordinateGuides>(guides_, guide_n_per_m_));
    const double size = (rest().colwise().maxCoeff() - rest().colwise().minCoeff()).maxCoeff();
    const Points start = x;
    const solve::ImplicitStep forever{0, std::numeric_limits<double>::infinity(), start};
    const solve::NewtonReport report = solve::Newton().solve_equilibrium(
        system, forever, {.iterations = 200, .tolerance_m = 1e-9 * size, .first_step_s = 1e3}, x);
    if (!report.converged) throw RunError("a problem of verification did not come to rest");
}

Points ProblemSetup::holding() const {
    Points force = Points::Zero(x.rows(), 3);
    solid->add_force(0, x, Points::Zero(x.rows(), 3), force);
    return -force;
}

}  // namespace risorius::figures
