// SPDX-License-Identifier: MIT
/// \file
/// Volume muscles of a face: grid solids with fibres and tendons under the skin, part of the same implicit solve.
///
///   unknowns  x = [tissue nodes; nodes of all solids]           one row each
///   E = cells (tissue/cell_solid.h) + chains (muscle/chain_set.h) + 1/2 k |p_tissue - p_muscle|^2 + 1/2 kn (d.n)^2
///
/// Nodes on bone ride on it. A node in the tissue is bound to the point of the tissue it lies in, and deep tissue on a
/// muscle to the point of the muscle it lies on, so that they move each other. Deep nodes of jaw muscles rest on their bone.
/// The tissue a muscle lies in keeps its own, much smaller, stiffness: that part of space is counted twice.
///
/// Preconditioner: with H the solids' second derivative (blocks of the muscles, bindings included), B the binding between
/// solids and tissue and S a scalar matrix over the tissue alone, the inverse of [H B; B^T S + B^T H^-1 B].
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/attachments.h"
#include "risorius/face/anatomy/detail/wrench.h"
#include "risorius/face/muscle/detail/muscle_placement.h"
#include "risorius/face/muscle/detail/muscle_surface.h"
#include "risorius/face/muscle/detail/solid_figures.h"
#include "risorius/face/muscle/detail/solid_placement.h"
#include "risorius/muscle/chain_set.h"
#include "risorius/solve/hessian_builder.h"
#include "risorius/solve/sparse_cholesky.h"
#include "risorius/solve/symmetric_factor.h"
#include "risorius/tissue/cell_solid.h"
#include "risorius/tissue/zero_length_springs.h"

namespace risorius::solve {
enum class Curvature;
}

namespace risorius::face {

using Wrenches = std::array<Wrench, kBodies>;

class MuscleSolids {
  public:
    /// `attachments` are those of the tissue; their nodes that lie on a muscle let go of the bone. Throws Error naming the
    /// muscle when it cannot be laid into this head.
    MuscleSolids(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
                 const Shell& shell, const TissueMesh& mesh, std::vector<Attachment>& attachments);

    bool empty() const { return parts_.empty(); }
    int nodes() const { return static_cast<int>(rest_.rows()); }
    const Points& rest() const { return rest_; }
    const Eigen::VectorXd& mass() const { return mass_; }  ///< per node, kg
    bool on_bone(int node) const {
        return placement_.nodes[static_cast<std::size_t>(node)].on_bone;
    }
    int parts() const { return static_cast<int>(parts_.size()); }
    bool is_solid(const std::string& muscle) const;

    /// Where skull and mandible are, motions from rest.
    void set_bodies(const std::array<Rigid, kBodies>& bodies);
    /// The same within a step: the directions in which bone holds muscles off stay those of its start.
    void move_bodies(const std::array<Rigid, kBodies>& bodies);
    /// Moves nodes as their bones move; nodes on bone exactly to where they belong.
    void carry(Points& x, const Rigid& from, const Rigid& to) const;
    /// Adds dE/d(motion of the mandible) of nodes that are carried along; `gradient` is that by the nodes.
    void add_riding(const Rigid& mandible, const Points& gradient, Wrench& sum) const;

    /// Factors are made anew for the next step, as by solids that never took one.
    void forget();
    /// Before the minimisation of a step of length h that starts at x.
    void begin_step(double h, const Points& x, const Eigen::VectorXd& activation);

    /// Returns E and adds dE/dx to `gradient`; nodes on bone are taken where the bodies are. Adds to `on_bodies`, when
    /// given, what the muscles exert on the bones; dE / d(motion of a body) is the negative of it.
    double add_energy(const Points& x, const Eigen::VectorXd& activation, Points& gradient,
                      Wrenches* on_bodies = nullptr) const;

    /// Before static energies from x on: no step, nothing is damped.
    void begin_rest(const Points& x);
    /// Adds the second derivative of add_energy at rest, over the rows of x.
    void add_hessian(const Points& x, const Eigen::VectorXd& activation, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const;

    /// What the tissue feels of the solids, over the tissue's nodes.
    void add_metric(solve::MetricBuilder& builder) const;

    /// y = M^-1 b over all unknowns; `tissue` is the factor over the tissue's nodes.
    void precondition(const solve::SparseCholesky& tissue, const Points& b, Points& y) const;

    void scale_strength(const std::string& muscle, double factor);
    double mean_stretch(const std::string& muscle, const Points& x,
                        const Eigen::VectorXd& activation) const;
    /// Returns the chains of one side of a muscle; none for a muscle that is no volume muscle.
    std::vector<muscle::ChainSet::State> chain_states(const std::string& muscle, Side side,
                                                      const Points& x,
                                                      const Eigen::VectorXd& activation) const;
    std::vector<SolidFigures> figures(const Points& x, const Eigen::VectorXd& activation) const;
    double max_volume_error(const Points& x) const;  ///< ratio
    /// Smooth surfaces of all muscles for drawing; then, wherever they are, their rows of `vertices`.
    void add_surfaces(MuscleSurfaces& surfaces);
    void place_surfaces(const Points& x, Points& vertices) const;

    /// What binds the tissue to the muscles where these are in x: 1/2 k |sum w_i x_i - target|^2 over nodes of the tissue.
    struct Spring {
        int nodes[4]{};
        double weights[4]{};
        int count = 0;
        Vec3 target = Vec3::Zero();
        double stiffness_n_per_m = 0;
    };
    void add_springs(const Points& x, std::vector<Spring>& springs) const;

  private:
    struct Part {
        SolidPart place;
        std::unique_ptr<tissue::CellSolid> cells;
        std::unique_ptr<muscle::ChainSet> chains;
        std::unique_ptr<solve::HessianBuilder> hessian;  ///< of its own nodes
        Points rest, start;
        mutable Points x, gradient;
        Eigen::SparseMatrix<double, Eigen::RowMajor>
            surface;  ///< points of the skin of the muscle by nodes
        Eigen::Index first_vertex = 0;
    };
    struct Binding {
        int tissue[4];
        double tissue_weight[4];
        int tissue_count;
        int solid[8];  ///< of the set's nodes
        double solid_weight[8];
        int solid_count;
        double stiffness_n_per_m;
        Vec3 apart_at_rest = Vec3::Zero();  ///< small, of nodes a little outside the tissue
    };
    /// Parts that share nodes, with their part of the preconditioner: of the step in which it was last made.
    struct Group {
        std::vector<int> part;
        std::vector<int> node;              ///< of the set
        std::vector<std::vector<int>> row;  ///< of each part's nodes, in `node`
        std::vector<std::size_t> binding;   ///< whose muscle end is in the group
        std::vector<std::size_t> support;
        std::unique_ptr<solve::HessianBuilder> hessian;
        solve::SymmetricFactor factor;
        Points made_at;
        std::vector<double> made_with;
        double made_for_s = 0;
        mutable std::vector<double> b, y;
    };
    void build_parts(const rig::RigDescription& rig);
    void add_surface(Part& part, MuscleSurfaces& surfaces) const;
    void bind(const TissueLocator& locator, const TissueMesh& mesh,
              std::vector<Attachment>& attachments);
    void add_supports();
    void take(const Part& part, const Points& x, Points& local) const;
    void build_groups();
    void refresh(Group& group, double h, const Points& x, const Eigen::VectorXd& activation);
    void solve_solids() const;  ///< solid_y_ = H^-1 solid_b_

    int first_ = 0;  ///< row of the first node in x
    SolidPlacement placement_;
    Points rest_, bone_;  ///< bone_: where nodes on bone are now
    Rigid mandible_ = Rigid::Identity();
    Eigen::VectorXd mass_;
    std::vector<Part> parts_;
    std::vector<Binding> bindings_;
    std::unique_ptr<tissue::ZeroLengthSprings> supports_;
    std::vector<int> support_node_;
    std::vector<int> held_tissue_;  ///< tissue nodes that do not move by themselves
    double step_s_ = 0;

    std::vector<Group> groups_;
    std::vector<int> row_;  ///< of each node in its group
    mutable Points solid_b_, solid_y_, tissue_b_, tissue_y_;
};

}  // namespace risorius::face
