// SPDX-License-Identifier: MIT
/// \file
/// Volume muscles of a face: solids under the skin, each a grid of hexahedral cells with fibres and tendons, or a mesh of tetrahedra with
/// fibres. They are part of the same implicit solve as the tissue.
///
///   unknowns  x = [nodes of the tissue; nodes of all volume muscles], one row each, m
///   E = bellies (solid_belly.h) + 1/2 k |p_tissue - p_muscle|^2 + 1/2 kn (d.n)^2
///
/// The second term is the sum over the bindings, springs of stiffness k, N/m. The last is the sum over the nodes that rest on bone: d is
/// the displacement from the place on the bone, m, n the outward direction, kn a stiffness, N/m.
///
/// Nodes on bone move with it. A binding ties a muscle node inside the tissue to the point of the tissue where it lies, or deep tissue to
/// the point of the muscle below it. So tissue and muscles move each other. Deep nodes of jaw muscles rest on their bone. Tissue and muscle
/// overlap: the tissue there keeps its own stiffness, which is much smaller than that of the muscle.
///
/// The preconditioner is the inverse of the block matrix [H B; B^T S + B^T H^-1 B], with the nodes of the muscles first:
/// - H: second derivative of the muscles, bindings included; B: the bindings between muscles and tissue
/// - S: a scalar matrix over the nodes of the tissue
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/attachments.h"
#include "risorius/face/anatomy/detail/wrench.h"
#include "risorius/face/muscle/detail/muscle_placement.h"
#include "risorius/face/muscle/detail/muscle_surface.h"
#include "risorius/face/muscle/detail/solid_belly.h"
#include "risorius/face/muscle/detail/solid_figures.h"
#include "risorius/face/muscle/detail/solid_placement.h"
#include "risorius/muscle/chain_set.h"
#include "risorius/solve/hessian_builder.h"
#include "risorius/solve/sparse_cholesky.h"
#include "risorius/solve/symmetric_factor.h"
#include "risorius/tissue/tet_solid.h"
#include "risorius/tissue/zero_length_springs.h"

namespace risorius::solve {
enum class Curvature;
}

namespace risorius::face {

/// One wrench per body.
using Wrenches = std::array<Wrench, kBodies>;

/// All volume muscles of a face: their energy, their part of the preconditioner, and measures. A part is one side of a muscle.
class MuscleSolids {
  public:
    /// `attachments` are those of the tissue. Where a volume muscle lies between tissue and bone, the tissue is bound to the muscle and the
    /// stiffness of its attachment is removed. Throws Error with the name of the muscle when it cannot be placed
    /// in this head.
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

    /// Sets the motions of skull and mandible from rest, at the start of a step.
    void set_bodies(const std::array<Rigid, kBodies>& bodies);
    /// The same within a step: the directions in which bone supports muscles stay those of the start of the step.
    void move_bodies(const std::array<Rigid, kBodies>& bodies);
    /// Moves the nodes x that follow the mandible, when its motion from rest changes from `from` to `to`. Nodes on bone are placed exactly.
    void carry(Points& x, const Rigid& from, const Rigid& to) const;
    /// Adds to `sum` dE/d(motion of the mandible) of the nodes that carry() moves. `gradient` is dE/dx, N.
    void add_riding(const Rigid& mandible, const Points& gradient, Wrench& sum) const;

    /// Forgets all factorised matrices, so that the next step depends on its arguments alone.
    void forget();
    /// Where the matrix of a group of muscles was factorised last.
    struct Factorised {
        Points at;                 ///< nodes of the group, m
        std::vector<double> with;  ///< activations of its muscles
        double for_s = 0;          ///< length of the step, s; 0: never
        Rigid mandible = Rigid::Identity();
    };
    /// Return this of each group, and factorise anew as then, which takes milliseconds: the next steps are those that followed. Afterwards
    /// the boundary conditions have to be set.
    std::vector<Factorised> factorised() const;
    void go_back_to(const std::vector<Factorised>& factorised);
    /// Prepares the minimisation of a step of length h, s, that starts at x.
    void begin_step(double h, const Points& x, const Eigen::VectorXd& activation);

    /// Returns E, J, and adds dE/dx to `gradient`, N. Nodes on bone are taken at their place on the bodies, not in x. Adds the forces of
    /// the muscles on the bones to `on_bodies` when it is given; dE/d(motion of a body) is their negative.
    double add_energy(const Points& x, const Eigen::VectorXd& activation, Points& gradient,
                      Wrenches* on_bodies = nullptr) const;

    /// Prepares static energies, without damping, at and around x.
    void begin_rest(const Points& x);
    /// Adds the second derivative of the static energy, N/m, over the rows of x.
    void add_hessian(const Points& x, const Eigen::VectorXd& activation, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const;

    /// Adds an upper bound of the stiffness with which the muscles hold the nodes of the tissue.
    void add_metric(solve::MetricBuilder& builder) const;

    /// Applies the preconditioner to b, one row per unknown, and writes y. `tissue` is the factor of the matrix of the tissue's nodes.
    void precondition(const solve::SparseCholesky& tissue, const Points& b, Points& y) const;

    /// Sets the maximum isometric force of a muscle, both sides, to `factor` times that of the start.
    void set_strength(const std::string& muscle, double factor);
    double mean_stretch(const std::string& muscle, const Points& x,
                        const Eigen::VectorXd& activation) const;
    /// Returns the chains of one side of a muscle; none for a muscle that is no volume muscle.
    std::vector<muscle::ChainSet::State> chain_states(const std::string& muscle, Side side,
                                                      const Points& x,
                                                      const Eigen::VectorXd& activation) const;
    /// Returns the maximum isometric force of all chains of the volume muscle of a column, N; std::nullopt for other columns.
    std::optional<double> greatest_force_n(int column) const;
    /// Returns one entry per part.
    std::vector<SolidFigures> figures(const Points& x, const Eigen::VectorXd& activation) const;
    /// Makes tetrahedra in which a muscle lies at least as stiff as the relaxed muscle across its fibres: fascia ties it to fat and
    /// skin there. `nodes`: of the tissue at rest, m; `mu_pa`: shear modulus, one entry per tetrahedron.
    void add_sheaths(const Points& nodes, const Tets& tets, Eigen::VectorXd& mu_pa) const;
    /// Returns one entry per part. `nodes`: of the tissue at rest, m.
    std::vector<BesideSolid> beside(const Points& nodes, const tissue::TetSolid& tissue) const;
    /// Returns one entry per cell, part by part.
    std::vector<SolidCellState> cell_states(const Points& x,
                                            const Eigen::VectorXd& activation) const;
    double max_volume_error(const Points& x) const;  ///< maximum of |volume / rest volume - 1|
    /// One side of a muscle as the mean of its fibres at rest.
    struct Line {
        std::string muscle;
        int column = 0;
        std::vector<Vec3> path;                  ///< from origin to insertion, m, head frame
        std::vector<rig::PathPoint::Body> body;  ///< that each point moves with
        double f0_n = 0;                         ///< of all chains
        muscle::ChainProperties chain;
    };
    std::vector<Line> lines() const;
    /// Adds smooth surfaces of all muscles for drawing. place_surfaces() then writes their rows of `vertices`, m.
    void add_surfaces(MuscleSurfaces& surfaces);
    void place_surfaces(const Points& x, Points& vertices) const;

    /// A spring from the tissue to a point of a muscle that does not move: 1/2 k |sum w_i x_i - target|^2. x_i are nodes of the tissue.
    struct Spring {
        int nodes[4]{};
        double weights[4]{};
        int count = 0;
        Vec3 target = Vec3::Zero();
        double stiffness_n_per_m = 0;
    };
    /// Adds the bindings as such springs, with the muscles held at x.
    void add_springs(const Points& x, std::vector<Spring>& springs) const;

  private:
    struct Part {
        std::unique_ptr<SolidBelly> belly;
        mutable Points x, gradient;
        /// Weights of the nodes in each point of the drawn surface.
        Eigen::SparseMatrix<double, Eigen::RowMajor> surface;
        Eigen::Index first_vertex = 0;
        const SolidPart& place() const { return belly->place(); }
    };
    struct Binding {
        int tissue[4];
        double tissue_weight[4];
        int tissue_count;
        int solid[8];  ///< nodes of the volume muscles
        double solid_weight[8];
        int solid_count;
        double stiffness_n_per_m;
        Vec3 apart_at_rest = Vec3::Zero();  ///< offset of a node just outside of the tissue, m
    };
    /// Parts that share nodes, and their block of the preconditioner as it was last factorised.
    struct Group {
        std::vector<int> part;
        std::vector<int> node;              ///< its nodes of the volume muscles
        std::vector<std::vector<int>> row;  ///< per part, index into `node` of each of its nodes
        std::vector<std::size_t> binding;   ///< bindings whose muscle end is in the group
        std::vector<std::size_t> support;
        std::unique_ptr<solve::HessianBuilder> hessian;
        solve::SymmetricFactor factor;
        Factorised made;
        mutable std::vector<double> b, y;
    };
    void build_parts(const rig::RigDescription& rig);
    void bind(const TissueLocator& locator, const TissueMesh& mesh,
              std::vector<Attachment>& attachments);
    void add_supports();
    void take(const Part& part, const Points& x, Points& local) const;
    void build_groups();
    void refresh(Group& group, double h, const Points& x, const Eigen::VectorXd& activation);
    void solve_solids() const;  ///< solid_y_ = H^-1 solid_b_

    int first_ = 0;  ///< row of the first node of the volume muscles in x
    SolidPlacement placement_;
    Points rest_, bone_;  ///< bone_: current positions of nodes on bone
    Rigid mandible_ = Rigid::Identity();
    Eigen::VectorXd mass_;
    std::vector<Part> parts_;
    std::vector<Binding> bindings_;
    std::unique_ptr<tissue::ZeroLengthSprings> supports_;
    std::vector<int> support_node_;
    std::vector<int> held_tissue_;  ///< tissue nodes that are not unknowns

    std::vector<Group> groups_;
    std::vector<int> row_;  ///< per node, its row in its group
    mutable Points solid_b_, solid_y_, tissue_b_, tissue_y_;
};

}  // namespace risorius::face
