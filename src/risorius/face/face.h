// SPDX-License-Identifier: MIT
/// \file
/// The simulated face of one rig: soft tissue, skin, muscles, jaw, lids and eyes. It is stepped in time by BDF2, the second-order
/// backward difference formula.
///
/// The state depends on the drives alone: the same drives give the same bytes. The equations are in
/// solver/detail/face_tissue.h. A drive without excitation (`track::Drive{}`) means that no muscle is active.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/muscle/detail/muscle_surface.h"
#include "risorius/face/skin/detail/face_pose.h"
#include "risorius/face/skin/detail/wrinkle_lines.h"
#include "risorius/face/solver/detail/face_tissue.h"
#include "risorius/face/solver/detail/static_solver.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"
#include "risorius/solve/energy_term.h"
#include "risorius/track/channels.h"
#include "risorius/track/motion.h"

namespace risorius::face {

/// Steps are fixed, independent of the frame rate of a video. The usual one; Quality may ask for another.
inline constexpr double kStep_s = 1.0 / 60.0;

/// Of an equilibrium, at most. Most take 100 to 200; lips that buckle as they roll in take up to 1,000.
inline constexpr int kRestIterations = 1500;

struct Quality {
    std::string name;
    int shell_vertices = 800;  ///< three nodes each
    int iterations = 6;        ///< per piece of a step, at most; as many again for volume
                               ///< muscles, and again for a jaw that muscles move
    int min_iterations = 0;    ///< before the tolerance may stop a piece
    int mouth_passes = 0;      ///< then, of the mouth alone, at most
    double tolerance_rms_m =
        0.0;  ///< stop when an iteration moves the nodes less, RMS; 0: always all iterations
    double step_s = kStep_s;
    double max_substep_s =
        kStep_s;  ///< a step is solved in so many equal pieces that none is longer
    solve::Precision precision = solve::Precision::kSingle;  ///< of the tissue's forces in steps
};
/// "draft": steps of 1/30 s, of eight iterations and ten of the mouth alone: as far again from converged steps as "preview"
/// is. "preview": six iterations and nine of the mouth alone, real time. "video": two pieces a step, each until an iteration
/// moves the nodes by less than 0.0025 mm RMS, after four at least.
/// "fine": as video, with 1,700 skin vertices.
Quality quality_named(const std::string& name);

using track::Motion;

struct MuscleState {
    double length_m = 0;  ///< mean of its fibres
    double stretch = 1;   ///< mean of its fibres, length over optimal length
    double force_n = 0;   ///< sum of its fibres
};

/// The drive at any time, s.
using DriveAt = std::function<track::Drive(double t_s)>;

class Face {
  public:
    /// `place` names the rig in messages. Throws Error when the mesh and the rig do not fit.
    Face(const rig::RigDescription& rig, const geom::PolygonMesh& mesh, const Quality& quality,
         const std::string& place);
    ~Face();
    Face(Face&&) noexcept;

    /// What moves the jaw, from the next start() or solve_equilibrium() on. At first its channels do.
    void drive_jaw_by(track::JawDrive by);
    /// Of pose_at(); dynamic at first. A quasi-static pose is sought from the one before.
    void move(Motion how);
    /// Which way weight pulls in the space the head turns in, m/s^2; at first downwards at 9.81. The rest shape is what an upright
    /// head has; nothing: that of a tilted head too, whose tissue then weighs nothing but its inertia is still felt.
    void set_gravity(const std::optional<Vec3>& gravity_m_s2);
    /// A rigid block between the incisors, as high as it holds them apart; 0 takes it away. Only for a jaw driven by muscles, and
    /// to be put in while it is open.
    void set_bite_block(double height_m);
    /// The drive as the muscles get it: with what the jaw's channels ask of them, when muscles move it.
    track::Drive driven(track::Drive drive) const;

    /// Time 0: activation and tissue in equilibrium with the drive, at rest.
    void start(const DriveAt& drive);

    /// One step of the quality's length.
    StepStats step(const DriveAt& drive);

    /// Steps until t, and the pose at t: between steps it is interpolated, so that frame rates share their common times.
    FacePose pose_at(double t_s, const DriveAt& drive);

    /// Static equilibrium for given activations (per column) and kinematic drive; leaves the face there.
    StepStats solve_equilibrium(const Eigen::VectorXd& activation, const track::Drive& kinematic,
                                const StaticOptions& options = {.iterations = kRestIterations});

    /// What follows is about the equilibrium that solve_equilibrium() left, with a jaw placed by its channels.
    /// Nodes, n x 3, m: tissue, then volume muscles.
    const Points& nodes() const;
    /// Slope g of the static energy, N, at any nodes, activation and drive: zero in equilibrium and on nodes that are held.
    Points static_gradient(const Points& nodes, const Eigen::VectorXd& activation,
                           const track::Drive& drive) const;
    /// H^-1 b, H = dg/d(nodes). With b the slope of a number L by the nodes and p anything g hangs on, also a number of the rig:
    /// dL/dp = - sum solve_static(b) * dg/dp.
    Points solve_static(const Points& b);
    /// Derivatives of all vertices, V x 3 each, m per unit: by activations of columns (the lids
    /// they move included), then by kinematic channels. At the kink of a lid's levator the mean of both sides.
    std::vector<Points> sensitivities(std::span<const int> columns,
                                      std::span<const track::Kinematic> channels);
    /// The slope by the nodes of a number whose slope by the vertices is given, V x 3, where bones and lids are held;
    /// without the folds of the skin.
    Points pull_back(const Points& vertex_gradient) const;

    /// After the last step. Surfaces that its few iterations left in each other are out of each other, see separation.h.
    FacePose pose() const;
    /// Of vertices that something else has moved, in the frame of the head: eyes, jaw and the head's own turn as the drive asks for.
    FacePose posed(Points vertices, const track::Drive& drive) const;
    /// The wrinkles of such a pose, by the strain of its skin. One thread at a time.
    void fold(FacePose& pose, const track::Drive& drive) const;
    double time_s() const;
    double step_s() const;
    const Eigen::VectorXd& activation() const;        ///< per column, at the last step
    Eigen::VectorXd activation_at(double t_s) const;  ///< interpolated like the pose

    /// The muscles as surfaces, made when first asked for, and where their vertices are at the time of the pose: after
    /// pose_at(t_s), with the head's own turn.
    const MuscleSurfaces& muscle_surfaces() const;
    Points muscle_vertices_at(double t_s) const;

    /// Where wrinkles lie that fold_depth of a pose is about; empty when the rig has none.
    const WrinkleLines& wrinkle_lines() const;

    /// Of what pose() shows after the last step or solve_equilibrium().
    Penetration penetration() const;

    int node_count() const;
    int tet_count() const;
    int inverted_tets() const;
    int dropped_tets() const;
    int fibre_count() const;
    double build_s() const;  ///< wall time of the construction, for benchmarks
    const rig::Head& head() const;
    /// The simulated skin at the mesh's own resolution, F x 3 mesh vertices.
    const Triangles& simulated_skin() const;
    const Shell& shell() const;
    const std::vector<StepStats>& history() const;  ///< of every piece since start()

    /// Adds a force to all others, see "How to add a force" in solve/energy_term.h. Its nodes are the rows of nodes(); its metric
    /// covers the nodes of the tissue only, the first node_count() rows. Call it before start().
    void add_force(std::shared_ptr<solve::EnergyTerm> force);

    /// The tetrahedra of the tissue, T x 4 indices of nodes().
    const Tets& tets() const;
    /// Potential energy of all energy terms at nodes(), J: without inertia and damping, with the contact pairs found last. The
    /// active work of muscles counts, so that it may be negative.
    double energy_j() const;

    /// Scales the force of every fibre of a muscle, for calibration.
    void scale_muscle(const std::string& muscle, double factor);
    void scale_lips(const rig::LipsDescription& lips);
    /// Mean length of a muscle's fibres over their rest length, now.
    double mean_stretch(const std::string& muscle) const;

    /// Length and force of one side of a muscle made of fibres, now. Nothing for volume muscles and unknown names. The force is
    /// isometric: it leaves out the effect of the fibres' speed.
    std::optional<MuscleState> muscle_state(const std::string& muscle, Side side) const;
    /// Position of a landmark of head().landmarks in pose(), m. A landmark that is no vertex rides on the nearest vertex of the
    /// skin. Throws std::out_of_range for an unknown landmark. Costs as much as pose().
    Vec3 landmark(const std::string& id) const;

    /// The volume muscles after the last step.
    std::vector<SolidFigures> solid_figures() const;

    /// Skin nodes, for tests and evaluation: current N x 3 and rest.
    Points skin_nodes() const;
    Points rest_skin_nodes() const;
    double kinetic_energy_j() const;
    double tissue_volume_m3() const;  ///< signed, of all tets

    /// The same skin, bone and mesh with other numbers of anatomy or tissue: what changes with them, at the same nodes.
    /// `changed` must place as many muscles' fibres as it likes but keep landmarks, thickness and jaw.
    class Variant {
      public:
        Variant(const Face& face, const rig::RigDescription& changed);
        ~Variant();
        /// dE/dx of everything but contact at given nodes, N; rows of fixed nodes are zero.
        Points static_gradient(const Points& nodes, const Eigen::VectorXd& activation,
                               const track::Drive& drive);

      private:
        struct Parts;
        std::unique_ptr<Parts> parts_;
    };

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace risorius::face
