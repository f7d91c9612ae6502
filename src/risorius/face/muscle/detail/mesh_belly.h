// SPDX-License-Identifier: MIT
/// \file
/// A belly that is a mesh of tetrahedra with fibres, without tendons.
///
///   E = shape (tissue/tet_solid.h) + volume around nodes (tissue/node_volumes.h) + stiffness along fibres (tissue/along_fibres.h)
///     + fibres (muscle/fibre_tets.h)
///
/// The fibres have the specific tension F0 L / V times their density: a prism of length L and volume V with fibres along it pulls
/// with F0, and each section of a spindle has the same fibres. Their force does not depend on their speed, as that of the chains of
/// a grid does not. A part of the resistance to a change of volume is that of each tetrahedron, kOwnVolume times the specific
/// tension: it keeps neighbours from exchanging volume when the fibres pull.
#pragma once

#include <memory>
#include <optional>

#include "risorius/face/muscle/detail/solid_belly.h"
#include "risorius/muscle/fibre_tets.h"
#include "risorius/tissue/along_fibres.h"
#include "risorius/tissue/node_volumes.h"
#include "risorius/tissue/tet_solid.h"

namespace risorius::face {

class MeshBelly final : public SolidBelly {
  public:
    static constexpr double kOwnVolume = 3;

    MeshBelly(const SolidPart& place, const SolidPlacement& nodes, const rig::RigDescription& rig);

    Eigen::VectorXd mass_kg() const override {
        return shape_->lumped_mass(kMuscleDensity_kg_m3, static_cast<int>(rest_.rows()));
    }
    void begin_step(double h, const Points& start) override;
    void add_energy(const Points& x, double activation, double& energy,
                    Points& gradient) const override;
    void add_hessian(const Points& x, double activation, solve::Curvature curvature,
                     const std::vector<int>& row, solve::HessianBuilder& hessian) const override;
    void add_stiffness(const Points& x, double activation, const std::vector<int>& row,
                       solve::HessianBuilder& hessian) const override;
    double f0_n() const override { return f0_n_; }
    void set_strength(double factor) override;
    double mean_stretch(const Points& x, double activation) const override;
    std::vector<muscle::ChainSet::State> chain_states(const Points& x,
                                                      double activation) const override;
    muscle::ChainProperties chain() const override;
    double volume(const Points& x) const override { return shape_->volume(x); }
    double rest_volume() const override { return rest_volume_; }
    SolidFigures figures(const Points& x, double activation) const override;
    void add_cell_states(const Points& x, double activation,
                         std::vector<SolidCellState>& states) const override;
    std::vector<std::vector<int>> sections() const override;
    BellySurface surface(const std::array<bool, 2>& bone_ends) const override;
    void find(const Vec3& p, double& least_excess, BellyPoint& best) const override;

  private:
    double density(int tet) const { return place_.density[static_cast<std::size_t>(tet)]; }
    /// RMS distance of the nodes in the middle third from their axis, m.
    double thickness(const Points& x) const;

    std::unique_ptr<tissue::TetSolid> shape_;
    std::unique_ptr<tissue::NodeVolumes> volumes_;
    std::optional<tissue::AlongFibres> along_;
    std::unique_ptr<muscle::FibreTets> fibres_;
    std::unique_ptr<solve::HessianBuilder> own_;  ///< over its own nodes
    std::vector<Mat3> inverse_;                   ///< of the matrix of edges at rest
    double rest_volume_ = 0, f0_n_ = 0, built_f0_n_ = 0;
    double damping_s_ = 0, step_s_ = 0;
    mutable double activation_ = 0;
};

}  // namespace risorius::face
