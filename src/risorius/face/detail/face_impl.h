// SPDX-License-Identifier: MIT
/// \file
/// Everything that a face consists of. `Face` and its views (statics.h, diagnostics.h, surfaces.h, fields.h, calibration.h) share one FaceImpl.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/detail/jaw_dynamics.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/face/muscle/detail/muscle_surface.h"
#include "risorius/face/skin/detail/face_poser.h"
#include "risorius/face/solver/detail/between_steps.h"
#include "risorius/face/solver/detail/driven_jaw.h"
#include "risorius/face/solver/detail/equilibrium.h"
#include "risorius/face/solver/detail/face_tissue.h"
#include "risorius/face/solver/detail/tissue_motion.h"
#include "risorius/face/view/detail/muscle_ribbons.h"
#include "risorius/muscle/activation.h"
#include "risorius/track/channels.h"

namespace risorius::face {

/// The parts of a face, in the order in which they are built, and its state.
struct FaceImpl {
    /// The state at one moment.
    struct State {
        Points x;                    ///< n x 3, m, rows as in FaceTissue::rest()
        Eigen::VectorXd activation;  ///< per column, 0..1
        track::Drive drive;
        JawDynamics::State jaw;  ///< used only when muscles move the jaw
    };

    /// All that the steps after one moment depend on, besides the drive.
    struct Kept {
        State now, before, earlier;
        TissueMotion::Past motion;
        Points last_move;
        bool went_back, in_step;
        long done;
        std::vector<tissue::Contacts::Memory> contacts;
        std::vector<MuscleSolids::Factorised> solids;
    };

    rig::RigDescription rig;
    Quality quality;
    int substeps;        ///< per step
    double substep_s;    ///< length of one implicit solve, s
    double build_s = 0;  ///< wall time of the construction, s
    rig::Head head;
    std::array<EyeLids, 2> lids;
    Jaw jaw;
    Shell shell;
    TissueMesh mesh;
    FaceTissue tissue;
    std::optional<FacePoser> poser;

    /// The states after the last substep, after the one before it, and after the one before that. Poses between the last two are
    /// interpolated.
    State now, before, earlier;
    std::optional<Equilibrium> equilibrium;
    DrivenJaw driven_jaw;
    bool went_back = false;  ///< the last substep reversed the move of the one before
    Points last_move;  ///< move of x in the last substep beyond that of bone, n x 3, m; or no rows
    Neck neck;
    TissueMotion motion;
    /// In the world frame, m/s^2; empty: see Face::set_gravity().
    std::optional<Vec3> gravity{JawDynamics::upright_gravity()};
    Motion how = Motion::kDynamic;
    long done = 0;         ///< substeps since start()
    bool in_step = false;  ///< the state comes from a substep, not from an equilibrium
    std::vector<StepStats> history;
    std::vector<double> built_f0_n;          ///< of each fibre; empty until a strength is changed
    std::map<std::string, double> strength;  ///< factors of Calibration::set_strength()
    std::optional<muscle::ActivationDynamics> dynamics;
    track::ChannelTable channels;
    MuscleSurfaces surfaces;
    std::optional<MuscleRibbons> ribbons;  ///< of the surfaces, built at the first request

    FaceImpl(const rig::RigDescription& rig_description, const geom::PolygonMesh& polygon_mesh,
             const Quality& q, const std::string& place);
    FaceImpl(const FaceImpl&) = delete;  // members refer to one another
    FaceImpl& operator=(const FaceImpl&) = delete;

    /// Returns the drive with one excitation per column: zeros if the drive has no excitations.
    track::Drive complete(track::Drive drive) const;
    /// Returns the activation that a constant drive leads to, per column.
    Eigen::VectorXd steady_activation(const track::Drive& drive) const;
    /// Returns gravity in the head frame, m/s^2. If `gravity` is empty, it is that of the upright head.
    Vec3 gravity_at(const track::Drive& drive) const;
    /// Returns the part of gravity that the rest shape does not contain, m/s^2.
    Vec3 weight_at(const track::Drive& drive) const;
    BoundaryState boundary_state(const Eigen::VectorXd& activation,
                                 const track::Drive& drive) const;
    /// Returns the springs of the drive's pulls over the nodes, head frame. Throws Error for a vertex that the tissue does not move.
    std::vector<PullSpring> pull_springs(const track::Drive& drive) const;
    bool is_soft(int vertex) const;  ///< soft tissue moves the vertex of the mesh
    /// Returns the state of the pulls of the last step or equilibrium.
    std::vector<HeldPull> held_pulls() const;
    /// Sets bones, lids and mouth pressure as the drive says, and moves the nodes x with the bones.
    void set_boundary_conditions(Points& x, const Eigen::VectorXd& activation,
                                 const track::Drive& drive);
    void set_boundary_conditions(const Eigen::VectorXd& activation, const track::Drive& drive);

    void start(const DriveAt& drive);
    /// Puts the face into an equilibrium that was found before. Throws std::logic_error when muscles move the jaw.
    void go_back_to(State found);
    Kept keep() const;
    void go_back_to(const Kept& then);
    StepStats substep(const DriveAt& drive_at);
    StepStats solve_equilibrium(const Eigen::VectorXd& activation, const track::Drive& drive,
                                const StaticOptions& options);
    /// Returns the current state as a pose of `equilibrium`. Throws std::logic_error when muscles move the jaw.
    Equilibrium::Pose equilibrium_pose() const;

    /// Returns t_s / length of a substep. A result that differs from a whole number only by rounding errors is rounded.
    double substeps_until(double t_s) const;
    /// Returns where t_s lies between the last two substeps, 0..1.
    double fraction_of_step(double t_s) const;
    /// Interpolates between the last two substeps. Drives are interpolated; bones and lids follow from the interpolated drive. The
    /// curve is smooth, but straight after a jump of the drive, where a smooth one would overshoot.
    State between(double fraction) const;
    /// Returns the activation of `between(fraction)`, per column.
    Eigen::VectorXd activation_between(double fraction) const;
    /// Returns the nodes as they are shown, n x 3, m: penetrations that a substep has left are resolved. Equilibria hardly have any.
    Points shown(const State& state) const;
    FacePose pose(double fraction) const;
    FacePose pose_of(const State& state) const;

    void make_surfaces();
    Points muscle_vertices(double fraction);

  private:
    /// Forgets all that was simulated, except the state.
    void forget();
    bool jumped() const;  ///< the drive has jumped in one of the last two substeps
    StateWeights weights(double fraction) const;
    track::Drive drive_between(const StateWeights& weights) const;
};

}  // namespace risorius::face
