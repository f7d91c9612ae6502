// SPDX-License-Identifier: MIT
/// \file
/// Soft blocks in one system with the obstacles they touch, for tests of contact in motion.
#pragma once

#include <memory>
#include <vector>

#include "risorius/contact/surface_samples.h"
#include "risorius/solve/integrator.h"
#include "risorius/solve/motion_system.h"
#include "risorius/solve/part_term.h"
#include "risorius/tissue/cell_solid.h"
#include "risorius/tissue/gravity.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::contact::testing {

/// One or more cubes of soft tissue, with a side of 0.1 m and 1 kg each. Nodes of the second follow those of the first.
struct SoftScene {
    static constexpr double kSide_m = 0.1, kMass_kg = 1.0;

    tissue::GridShape grid{3, 3, 3};
    Eigen::VectorXd mass;
    solve::MotionState state;
    std::vector<std::shared_ptr<solve::EnergyTerm>> terms;
    int blocks = 0;

    /// Adds a cube with its lowest corner at `low`.
    void add_block(const Vec3& low, double viscosity_pa_s = 50) {
        const double shear_pa = 2e4;
        const auto shape = [=](const Vec3& a) { return Vec3(low + kSide_m * a); };
        const tissue::CellModuli moduli{shear_pa, 5 * shear_pa, viscosity_pa_s};
        auto body = tissue::cell_body(tissue::uniform_cells(grid), shape, moduli,
                                      kMass_kg / (kSide_m * kSide_m * kSide_m));
        const int first = static_cast<int>(state.x.rows()), count = grid.size();
        const auto append = [&](auto& whole, const auto& part) {
            const auto before = whole.eval();
            whole.resize(first + count, part.cols());
            whole << before, part;
        };
        append(state.x, body.rest);
        state.v = Points::Zero(first + count, 3);
        append(mass, body.mass_kg);
        terms.push_back(std::make_shared<solve::PartTerm>(
            std::make_shared<tissue::CellSolid>(std::move(body)), first, count));
        ++blocks;
    }

    Triangles surface(int block = 0) const {
        return tissue::surface_triangles(grid).array() + block * grid.size();
    }

    template <class Term>
    std::shared_ptr<Term> add(std::shared_ptr<Term> term) {
        terms.push_back(term);
        return term;
    }
    void add_gravity(const Vec3& gravity) { add(std::make_shared<tissue::Gravity>(mass, gravity)); }

    solve::MotionSystem system() const {
        solve::MotionSystem system(mass,
                                   std::vector<char>(static_cast<std::size_t>(mass.size()), 0));
        for (const auto& term : terms) system.add(term);
        return system;
    }

    Vec3 middle(int block = 0) const { return weighted(state.x, block); }
    Vec3 velocity(int block = 0) const { return weighted(state.v, block); }

  private:
    Vec3 weighted(const Points& rows, int block) const {
        const int first = block * grid.size(), count = grid.size();
        return (mass.segment(first, count).transpose() * rows.middleRows(first, count))
                   .transpose() /
               mass.segment(first, count).sum();
    }
};

inline std::unique_ptr<solve::Integrator> implicit_steps(double step_s) {
    return solve::make_integrator({.method = solve::Method::kImplicitEuler,
                                   .step_s = step_s,
                                   .length_scale_m = SoftScene::kSide_m,
                                   .newton_iterations = 30,
                                   .newton_tolerance = 1e-6});
}

inline std::unique_ptr<solve::Integrator> explicit_steps(double step_s) {
    return solve::make_integrator({.method = solve::Method::kRungeKutta4,
                                   .step_s = step_s,
                                   .length_scale_m = SoftScene::kSide_m});
}

}  // namespace risorius::contact::testing
