// SPDX-License-Identifier: MIT
/// \file
/// The soft tissue of a face as one system of equations over its nodes.
///
/// A step of length h minimises over the node positions x, n x 3, m
///
///     E = |x - a|^2_M / (2 h^2) + beta/(2 h) sum V mu |F - F_n|^2 + sum of the energy terms (face_terms.h)
///
/// - a: the positions that the nodes would reach without forces. TissueMotion sets h and a so that the steps are those of BDF2.
/// - M: lumped mass, kg; beta: damping time, s
/// - F, F_n: deformation gradients of a tetrahedron now and at the start of the step; V: its volume, m^3; mu: its shear modulus, Pa
///
/// The minimiser is L-BFGS with one prefactored matrix per h.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/attachments.h"
#include "risorius/face/anatomy/detail/cheek.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/detail/jaw_dynamics.h"
#include "risorius/face/anatomy/detail/wrench.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/muscle/detail/lip_drive.h"
#include "risorius/face/muscle/detail/muscle_placement.h"
#include "risorius/face/muscle/detail/muscle_solids.h"
#include "risorius/face/solver/detail/boundary_state.h"
#include "risorius/face/solver/detail/contact_search.h"
#include "risorius/face/solver/detail/face_terms.h"
#include "risorius/face/solver/detail/local_solve.h"
#include "risorius/face/solver/detail/separation.h"
#include "risorius/face/solver/detail/terms/contact_term.h"
#include "risorius/face/solver/detail/terms/skin_term.h"
#include "risorius/face/step_stats.h"
#include "risorius/muscle/fibre_set.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"
#include "risorius/solve/quasi_newton.h"
#include "risorius/solve/sparse_cholesky.h"
#include "risorius/tissue/collagen_tets.h"
#include "risorius/tissue/contacts.h"
#include "risorius/tissue/skin_sheet.h"
#include "risorius/tissue/tet_solid.h"

namespace risorius::solve {
enum class Curvature;
class HessianBuilder;
}  // namespace risorius::solve

namespace risorius::face {

/// A step of a jaw that its muscles move, for the common solve with the tissue.
struct JawInStep {
    const JawDynamics& dynamics;
    JawDynamics::Step step;
    JawVector q;  ///< coordinates at the start of the step; the solve replaces them by the result
};

/// The tissue of one face: its energy terms, its steps, and its static energy.
class FaceTissue {
  public:
    FaceTissue(const FaceTissue&) = delete;  // its terms refer to its members
    FaceTissue& operator=(const FaceTissue&) = delete;
    /// Keeps references: all arguments must outlive it.
    FaceTissue(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
               const std::array<EyeLids, 2>& lids, const Shell& shell, const TissueMesh& mesh);

    /// Factorises the matrices for steps of length h, s. Call it before the first such step.
    void prepare(double h);

    /// Sets the precision of the tissue forces in time steps. Equilibria use double precision.
    void step_in(solve::Precision precision) { inputs_.precision = precision; }

    /// Sets the number of extra iterations restricted to the mouth after each dynamic step. The soft lips converge last.
    void refine_mouth(int iterations) { mouth_iterations_ = iterations; }

    void set_boundary_conditions(const BoundaryState& prescribed);

    /// Moves the nodes x, n x 3, m, that follow the mandible, when its motion from rest changes from `from` to `to`.
    void carry_with_bone(Points& x, const Rigid& from, const Rigid& to) const {
        terms_.carry(x, from, to);
    }

    /// Finds the contact pairs at x; they are used until the next call. The shifts of contacts that were in the list before are kept
    /// (contacts.h).
    void find_contacts(const Points& x);
    void forget_contacts() { contacts_.forget(); }
    void recall_contacts(const std::vector<tissue::Contacts::Memory>& memory) {
        contacts_.recall(memory);
    }
    /// Searches contact pairs at x and returns their penetration. Does not change the pairs in use.
    Penetration penetration(const Points& x) const;
    /// Returns x with penetrations resolved for display, see separation.h.
    Points resolve_penetration(const Points& x, const Rigid& mandible,
                               const std::array<Mat3, 2>& gaze) const {
        return face::resolve_penetration(x, search_, mandible, gaze, fixed_);
    }

    /// Solves one step of length h, s. `start` and `aim` are n x 3, m: the positions at the start of the step, and a (see above). x is
    /// the first guess and becomes the result. `warm_start` has moves of x, n x 3, m, from which the first curvature pairs of L-BFGS are made.
    StepStats implicit_step(double h, const Points& start, const Points& aim,
                            const Eigen::VectorXd& activation,
                            const solve::QuasiNewtonOptions& options, Points& x,
                            std::span<const Points> warm_start = {});

    /// Prepares static energies, without inertia and damping, at and around x.
    void begin_rest(const Points& x) { solids_->begin_rest(x); }
    /// Returns the static energy, J, and its gradient, n x 3, N, zero on fixed rows. Call begin_rest() first.
    double static_energy(const Points& x, const Eigen::VectorXd& activation,
                         Points& gradient) const;
    /// Adds the second derivative of the static energy, N/m, with the contact pairs as they were found last. Pairs that do not touch add
    /// zeros, so that the pattern of the matrix does not depend on which pairs touch.
    void add_static_hessian(const Points& x, const Eigen::VectorXd& activation,
                            solve::Curvature curvature, solve::HessianBuilder& hessian) const;
    const std::vector<char>& fixed() const { return fixed_; }  ///< one flag per row of x
    const tissue::Contacts& contacts() const { return contacts_; }
    /// Puts other contacts in place of the present ones, which are returned.
    std::vector<tissue::Contacts::Contact> exchange_contacts(
        std::vector<tissue::Contacts::Contact> contacts) {
        return std::exchange(contacts_.list(), std::move(contacts));
    }
    /// Returns pairs of nodes whose contact is likely, see ContactSearch.
    std::vector<std::pair<int, int>> neighbours_across_lips() const {
        return search_.neighbours_across_lips();
    }
    /// Like find_contacts(), for equilibria: contacts become stiffer with depth and have no memory of former solves.
    void find_rest_contacts(const Points& x);
    /// Like find_contacts(), without memory: for the first iterations towards an equilibrium.
    void find_soft_contacts(const Points& x);
    /// Ends the search for an equilibrium at x: returns depths and volume error, and sets the memory of the contacts so that in time steps
    /// from here contacts press equally hard.
    StepStats end_rest(const Points& x);
    /// Sets the contacts to `found`, which were found when the motion of the mandible was `from`. Contacts with the mandible are moved
    /// along with it.
    void ride_contacts(const std::vector<tissue::Contacts::Contact>& found, const Rigid& from);
    /// Returns the motion of the mandible from rest.
    const Rigid& mandible() const { return mandible_; }
    /// Returns the gradient of the static energy with the contacts as they were found last, n x 3, N; zero on fixed rows.
    Points static_gradient(const Points& x, const Eigen::VectorXd& activation) const;

    int nodes() const { return static_cast<int>(mesh_.nodes.rows()); }  ///< of the tissue
    /// Positions at rest, n x 3, m: nodes of the tissue, then those of the volume muscles. All states have these rows.
    const Points& rest() const { return rest_; }
    const MuscleSolids& solids() const { return *solids_; }
    MuscleSolids& solids() { return *solids_; }
    /// Adds a force after all others. Its nodes are the rows of rest(); its metric may only refer to nodes of the tissue.
    void add_term(std::shared_ptr<solve::EnergyTerm> term);
    void scale_lips(const rig::LipsDescription& lips) {
        lip_drive_->scale(lips);
        forget_mouth();
    }
    /// Call it after a change of forces, because the local solve of the mouth has copies of them.
    void forget_mouth() { mouth_.reset(); }
    /// Solves one step of the tissue together with a jaw that its muscles move: minimises the sum of both energies over the nodes and
    /// the coordinates of the jaw. The boundary conditions must be those with the jaw at the start of its step.
    StepStats implicit_step(double h, const Points& start, const Points& aim,
                            const Eigen::VectorXd& activation,
                            const solve::QuasiNewtonOptions& options, Points& x, JawInStep& jaw);

    /// Measures the stiffness of the resting tissue against the motion of a jaw, for steps of length h, s. Call it before the first such
    /// step. Afterwards the boundary conditions are those of rest.
    void prepare(double h, const JawDynamics& jaw);
    const JawMatrix& ride_stiffness(double h) const;  ///< the measured stiffness, N/m

    const tissue::TetSolid& tets() const { return *tets_; }
    /// Null if the rig has no regions of collagen.
    const tissue::CollagenTets* collagen() const { return collagen_.get(); }
    const muscle::FibreSet& fibres() const { return *fibres_; }
    muscle::FibreSet& fibres() { return *fibres_; }
    const MusclePlacement& muscles() const { return muscles_; }  ///< at rest
    const Eigen::VectorXd& mass() const { return mass_; }        ///< per node, kg

  private:
    struct Metric {
        double h;
        solve::SparseCholesky factor;
    };
    double lid_fraction(const Vec3& p) const;
    double lip_fraction(const Vec3& p) const;
    double cheek_ratio(const Vec3& p) const;
    void build_tissue();
    void build_skin();
    std::shared_ptr<FaceTerm> make_attachment_term() const;
    void find_cheeks(const Jaw& jaw);
    const solve::SparseCholesky& metric(double h);
    /// Starts a step. After this, step_energy() returns E, J, and its gradient by the nodes, n x 3, N.
    void begin_step(double h, const Points& start, const Eigen::VectorXd& activation);
    double step_energy(double h, const Points& aim, const Eigen::VectorXd& activation,
                       const Points& at, Points& gradient);
    void put_depths(const Points& x, StepStats& figures) const;
    /// Makes the extra iterations for the mouth after those of a time step.
    void refine(double h, const Points& start, const Points& aim, const Eigen::VectorXd& activation,
                const solve::QuasiNewtonOptions& options, Points& x);
    bool refines_mouth(double h) const { return mouth_iterations_ > 0 && h < kSettling_s; }
    LocalSolve make_mouth(double h) const;
    StepStats end_step(const solve::StepReport& report, const Points& x);
    /// Moves the mandible within a step: targets on it follow, directions stay those of the start of the step.
    void move_mandible(const Rigid& moved);
    /// Fills the list of energy terms.
    void build_terms();

    const rig::Head& head_;
    const rig::RigDescription& rig_;
    const Jaw& jaw_;
    const std::array<EyeLids, 2>& lids_;
    const Shell& shell_;
    const TissueMesh& mesh_;
    std::vector<Vec3> lips_;
    CheekRegions cheek_;
    std::vector<Attachment> attachments_;
    std::optional<MuscleSolids> solids_;
    Points rest_;
    std::vector<char> fixed_;  // one flag per row of x
    std::optional<tissue::TetSolid> tets_;
    SkinSheetParts sheet_;
    std::optional<tissue::SkinSheet> skin_;
    muscle::HillShape hill_;
    MusclePlacement muscles_;
    std::optional<muscle::FibreSet> fibres_;
    mutable std::optional<LipDrive> lip_drive_;  // add_energy() sets its activation
    ContactSearch search_;
    tissue::Contacts contacts_;
    Rigid mandible_ = Rigid::Identity();
    std::array<Mat3, 2> gaze_{Mat3::Identity(), Mat3::Identity()};
    std::shared_ptr<ContactTerm> contact_term_;
    std::shared_ptr<tissue::CollagenTets> collagen_;
    std::vector<std::pair<double, JawMatrix>> ride_stiffness_;  // by h
    std::vector<std::pair<int, Vec3>> cheeks_;                  // deep node, outward area, m^2
    Eigen::VectorXd mass_;
    std::vector<Metric> metrics_;  // one per step length used
    solve::QuasiNewton newton_;
    FaceTerms terms_;
    mutable TermInputs inputs_;
    Points step_start_;  // positions at the start of the current step
    int mouth_iterations_ = 0;
    std::optional<LocalSolve> mouth_;  // for the step length used last
    Points carried_, carried_gradient_;
};

}  // namespace risorius::face
