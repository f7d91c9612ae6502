// SPDX-License-Identifier: MIT
/// \file
/// The simulated face of one rig: soft tissue, skin, muscles, jaw, lids and eyes. It is stepped in time by BDF2, the second-order
/// backward difference formula, or put into static equilibrium.
///
/// The state depends on the drives alone: the same drives give the same bytes. The equations are in
/// solver/detail/face_tissue.h.
///
/// `Face` itself steps and poses. Four views give the rest; each has a header of its own:
/// - `statics()` (statics.h): gradient, linear solves and sensitivities of an equilibrium
/// - `diagnostics()` (diagnostics.h): muscles, landmarks, energies, penetration, mesh, history of the solver
/// - `surfaces()` (surfaces.h): surfaces of the muscles, wrinkles, vertices that something else has moved
/// - `calibration()` (calibration.h): strengths of a face that is already built
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
class Statics;
class Surfaces;
struct FaceImpl;

/// Maximum number of iterations for an equilibrium. Most need 100 to 200; lips that buckle while they roll in need up to 1,000.
inline constexpr int kRestIterations = 1500;

using track::Motion;

/// The drive as a function of time, s. A drive without excitation (`track::Drive{}`) means that no muscle is active. Functions that take
/// a drive throw Error when its vectors have another size than the rig has columns, or when an excitation is not finite.
using DriveAt = std::function<track::Drive(double t_s)>;

class Face {
  public:
    /// `place` names the rig in messages. Throws Error when the mesh and the rig do not fit.
    Face(const rig::RigDescription& rig, const geom::PolygonMesh& mesh, const Quality& quality,
         const std::string& place);
    ~Face();
    Face(Face&&) noexcept;

    /// Sets what moves the jaw, from the next start() or solve_equilibrium() on. The default is the channels of the jaw.
    void drive_jaw_by(track::JawDrive by);
    /// Sets whether pose_at() is dynamic (the default) or quasi-static. The search for a quasi-static pose starts at the one before.
    void move(Motion how);
    /// Sets gravity in the world frame, m/s^2; the default is 9.81 downwards. The rest shape is that of an upright head. Without a
    /// value it is that of a tilted head too: the tissue then has inertia but no weight.
    void set_gravity(const std::optional<Vec3>& gravity_m_s2);
    /// Puts a rigid block between the incisors that holds them `height_m` apart; 0 removes it. Only for a jaw that its muscles
    /// move. Insert the block while the jaw is open.
    void set_bite_block(double height_m);
    /// Adds a force to all others, see "How to add a force" in solve/energy_term.h. Its nodes are the rows of Statics::nodes(). Its
    /// metric covers the nodes of the tissue only, the first Diagnostics::node_count() rows. Call it before start().
    void add_force(std::shared_ptr<solve::EnergyTerm> force);

    /// Sets the time to 0 and puts activation and tissue into equilibrium with the drive.
    void start(const DriveAt& drive);
    /// Advances by one step of length step_s().
    StepStats step(const DriveAt& drive);
    /// Advances until t and returns the pose at t. Between steps the pose is interpolated, so that videos of different frame rates
    /// agree at common times.
    FacePose pose_at(double t_s, const DriveAt& drive);
    /// Puts the face into static equilibrium with activations (per column, 0..1) and the kinematic channels of a drive.
    StepStats solve_equilibrium(const Eigen::VectorXd& activation, const track::Drive& kinematic,
                                const StaticOptions& options = {.iterations = kRestIterations});

    /// Returns the pose after the last step or equilibrium. Surfaces that a step left in each other are separated (separation.h).
    FacePose pose() const;
    double time_s() const;                            ///< since start()
    double step_s() const;                            ///< of the quality
    const Eigen::VectorXd& activation() const;        ///< per column, after the last step
    Eigen::VectorXd activation_at(double t_s) const;  ///< interpolated like the pose
    const rig::Head& head() const;

    /// Views. Each remains valid as long as the face exists, also when the face is moved. Include the header of the view.
    Statics statics() const;
    Diagnostics diagnostics() const;
    Surfaces surfaces() const;
    Calibration calibration();

  private:
    friend class Variant;
    std::unique_ptr<FaceImpl> impl_;
};

}  // namespace risorius::face
