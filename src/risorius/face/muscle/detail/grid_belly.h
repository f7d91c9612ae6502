// SPDX-License-Identifier: MIT
/// \file
/// A belly that is a grid of cells with chains of fibres along its first axis, and tendons in series with them.
///
///   E = cells (tissue/cell_solid.h) + stiffness along fibres (tissue/along_fibres.h) + chains (muscle/chain_set.h)
#pragma once

#include <memory>
#include <optional>

#include "risorius/face/muscle/detail/solid_belly.h"
#include "risorius/tissue/along_fibres.h"
#include "risorius/tissue/cell_solid.h"

namespace risorius::face {

class GridBelly final : public SolidBelly {
  public:
    GridBelly(const SolidPart& place, const SolidPlacement& nodes, const rig::RigDescription& rig);

    Eigen::VectorXd mass_kg() const override { return cells_->body().mass_kg; }
    void begin_step(double h, const Points& start) override;
    void add_energy(const Points& x, double activation, double& energy,
                    Points& gradient) const override;
    void add_hessian(const Points& x, double activation, solve::Curvature curvature,
                     const std::vector<int>& row, solve::HessianBuilder& hessian) const override;
    void add_stiffness(const Points& x, double activation, const std::vector<int>& row,
                       solve::HessianBuilder& hessian) const override;
    double f0_n() const override { return chains_->size() * chains_->properties().f0_n; }
    void set_strength(double factor) override { chains_->set_f0(factor * built_f0_n_); }
    double mean_stretch(const Points& x, double activation) const override {
        return chains_->mean_stretch(x, activation);
    }
    std::vector<muscle::ChainSet::State> chain_states(const Points& x,
                                                      double activation) const override {
        return chains_->states(x, activation);
    }
    muscle::ChainProperties chain() const override { return chains_->properties(); }
    double volume(const Points& x) const override { return cells_->volume(x); }
    double rest_volume() const override { return cells_->rest_volume(); }
    SolidFigures figures(const Points& x, double activation) const override;
    void add_cell_states(const Points& x, double activation,
                         std::vector<SolidCellState>& states) const override;
    std::vector<std::vector<int>> sections() const override;
    BellySurface surface(const std::array<bool, 2>& bone_ends) const override;
    void find(const Vec3& p, double& least_excess, BellyPoint& best) const override;

  private:
    void add_cells(const Points& x, solve::Curvature curvature, const std::vector<int>& row,
                   solve::HessianBuilder& hessian) const;

    std::unique_ptr<tissue::CellSolid> cells_;
    std::optional<tissue::AlongFibres> along_;
    std::unique_ptr<muscle::ChainSet> chains_;
    std::unique_ptr<solve::HessianBuilder> own_;  ///< over its own nodes
    double built_f0_n_ = 0;                       ///< of one chain
    double step_s_ = 0;
    Points start_;
};

}  // namespace risorius::face
