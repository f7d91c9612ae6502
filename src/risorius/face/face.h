// SPDX-License-Identifier: MIT
/// \file
/// The simulated face of one rig: soft tissue, skin, muscles, jaw, lids and eyes. It is stepped in time by BDF2, the second-order
/// backward difference formula, or put into static equilibrium.
///
/// The state depends on the drives alone: the same drives give the same bytes. The equations are in docs/theory/integrator.md.
///
/// `Face` itself steps in time and returns poses. Five views give access to the rest; each has a header of its own:
/// - `statics()` (statics.h): gradient, linear solves and sensitivities of an equilibrium
/// - `diagnostics()` (diagnostics.h): state of the muscles, landmarks, energies, penetration, mesh, history of the solver
/// - `surfaces()` (surfaces.h): surfaces of the muscles, wrinkles, poses from given vertices
/// - `fields()` (fields.h): stress, contact and muscles as fields over the meshes
/// - `calibration()` (calibration.h): changes of the muscle strengths of a face that is already built
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "risorius/core/types.h"
#include "risorius/face/quality.h"
#include "risorius/face/skin/detail/face_pose.h"
#include "risorius/face/solver/detail/static_options.h"
#include "risorius/face/step_stats.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/head.h"
#include "risorius/rig/rig_description.h"
#include "risorius/solve/energy_term.h"
#include "risorius/track/channels.h"
#include "risorius/track/motion.h"

namespace risorius::face {

class Calibration;
class Diagnostics;
class KeptFace;
class Fields;
class Statics;
class Surfaces;
struct FaceImpl;

/// Maximum number of iterations for an equilibrium. Most equilibria need 100 to 200; those with lips that buckle while they roll in need
/// up to 1,000.
inline constexpr int kRestIterations = 1500;

using track::Motion;

/// The drive as a function of time, s. A drive without excitation (`track::Drive{}`) means that no muscle is active. Functions that take
/// a drive throw Error when one of its vectors does not have one entry per column of the rig, or when an excitation is not finite.
using DriveAt = std::function<track::Drive(double t_s)>;

/// A simulated face: the rig on its mesh, and the state of tissue, muscles and jaw.
class Face {
  public:
    /// `place` names the rig in messages. Throws Error when the mesh does not fit the rig.
    Face(const rig::RigDescription& rig, const geom::PolygonMesh& mesh, const Quality& quality,
         const std::string& place);
    ~Face();
    Face(Face&&) noexcept;

    /// Sets what moves the jaw, from the next start() or solve_equilibrium() on. The default is the channels of the jaw.
    void drive_jaw_by(track::JawDrive by);
    /// Sets whether pose_at() is dynamic (the default) or quasi-static. The search for a quasi-static pose starts at the last pose.
    void move(Motion how);
    /// Sets gravity in the world frame, m/s^2; the default is (0, -9.81, 0). The rest shape is that of an upright head under this
    /// default, so only the difference from it deforms the tissue. std::nullopt turns the difference off: the tissue does not sag
    /// when the head tilts, but it keeps its inertia.
    void set_gravity(const std::optional<Vec3>& gravity_m_s2);
    /// Puts a rigid block between the incisors that holds them `height_m` apart; 0 removes it. Insert the block while the jaw is
    /// open. Throws std::logic_error unless muscles move the jaw.
    void set_bite_block(double height_m);
    /// Adds a force to those of the face, see "How to add a force" in solve/energy_term.h. Its nodes are the rows of Statics::nodes(). Its
    /// metric may only refer to nodes of the tissue, the first Diagnostics::node_count() rows. Call add_force() before start().
    void add_force(std::shared_ptr<solve::EnergyTerm> force);

    /// Sets the time to 0 and puts activation and tissue into equilibrium with the drive.
    void start(const DriveAt& drive);
    /// Advances by one step of length step_s().
    StepStats step(const DriveAt& drive);
    /// Advances to the time t_s, s, and returns the pose there. Between steps the pose is interpolated, so that videos of different
    /// frame rates agree at common times. If poses are quasi-static, it solves the equilibrium with the drive at t_s instead.
    FacePose pose_at(double t_s, const DriveAt& drive);
    /// Returns a copy of all that the steps from now on depend on, some megabytes (kept_face.h).
    KeptFace keep() const;
    /// Goes back to a moment of this face: the same drives then give the same bytes as after that moment. What drives the jaw and gravity
    /// must be as they were then.
    void go_back_to(const KeptFace& moment);
    /// Puts the face into static equilibrium. `activation` has one entry per column, 0..1; if it is empty, no muscle is active. Of
    /// `kinematic`, only the kinematic channels count.
    StepStats solve_equilibrium(const Eigen::VectorXd& activation, const track::Drive& kinematic,
                                const StaticOptions& options = {.iterations = kRestIterations});

    /// Returns the pose after the last step or equilibrium. Penetrations that a step has left are resolved, in this pose only.
    FacePose pose() const;
    double time_s() const;                            ///< since start(), s
    double step_s() const;                            ///< length of a step, s: Quality::step_s
    const Eigen::VectorXd& activation() const;        ///< per column, 0..1, after the last step
    Eigen::VectorXd activation_at(double t_s) const;  ///< interpolated like the pose
    const rig::Head& head() const;

    /// Views of the face. A view remains valid as long as the face exists, also after a move of the Face object (std::move). Include
    /// the header of the view that you use.
    Statics statics() const;
    Diagnostics diagnostics() const;
    Surfaces surfaces() const;
    Fields fields() const;
    Calibration calibration();

  private:
    friend class Variant;
    std::unique_ptr<FaceImpl> impl_;
};

}  // namespace risorius::face
