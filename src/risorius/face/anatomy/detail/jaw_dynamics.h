// SPDX-License-Identifier: MIT
/// \file
/// Dynamics of the jaw: the mandible is a rigid body on two condyles, and the hyoid bone is a point mass. Muscles move both.
///
///   q     coordinates (jaw_joint.h)     p_i  six points that carry the mass and inertia of the mandible, and the hyoid
///   m_i   mass of p_i      v_i  velocity of p_i      q_n  coordinates at the start of the step      D  damping, diagonal
/// A step of length h minimises over q
///   E = sum m_i |p_i(q) - a_i|^2 / (2 h^2) + |q - q_n|^2_D / (2 h) + muscles + limits + hyoid sling + weight + tone,
///   a_i = p_i(q_n) + h v_i,   v_i after the step = (p_i(q) - p_i(q_n)) / h
/// This is implicit Euler, of first order. The tissue uses BDF2 (tissue_motion.h), so its h in the common solve is another. The minimum
/// is found by Newton's method with a positive second derivative and a line search. The tissue acts through `JawLoad`.
///
/// At rest the closing muscles have a constant tone (activation 0.012). It carries the weight of the jaw and presses the molars lightly
/// together. The capsules are assumed to balance its pull along the slides and the passive tension at rest. So rest is an exact
/// equilibrium, and an open jaw closes when its muscles relax.
///
/// Something must hold the hyoid against geniohyoid, mylohyoid and digastric. The infrahyoid muscles are not in the muscle table; a spring takes
/// their place. It pulls towards a place that depends on the opening of the jaw at the start of the step: 14 mm back and 10 mm down at 32
/// degrees.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/face/anatomy/detail/jaw_joint.h"
#include "risorius/face/anatomy/detail/jaw_muscles.h"

namespace risorius::face {

inline constexpr double kGravity_m_s2 = 9.81;

/// A quadratic energy of the jaw about the coordinates `at`. It stands for the tissue.
struct JawLoad {
    JawVector at = JawVector::Zero();
    JawVector gradient = JawVector::Zero();   ///< N
    JawMatrix stiffness = JawMatrix::Zero();  ///< N/m, positive
};

/// Steps the jaw in time. Coordinates q and gradients are those of jaw_joint.h.
class JawDynamics {
  public:
    /// `solids` names the jaw muscles that are volume muscles. Here they have only their tone; the volume muscles exert the other forces.
    JawDynamics(const rig::Head& head, const rig::RigDescription& rig,
                const std::set<std::string>& solids = {});

    static constexpr int kMassPoints = 7;  ///< the last one is the hyoid
    using MassPoints = std::array<Vec3, kMassPoints>;
    struct State {
        JawVector q = JawVector::Zero();
        MassPoints velocity = still();  ///< relative to space, in the head frame, m/s
    };
    static MassPoints still();  ///< zero velocities

    /// Motion of the head during a step as the jaw sees it. `moved` is the motion, in the head frame, of points that rest in space.
    struct Carriage {
        Rigid moved = Rigid::Identity();
        Vec3 gravity_m_s2 = upright_gravity();
    };
    static Vec3 upright_gravity() { return {0, -kGravity_m_s2, 0}; }

    /// Constants of a step.
    struct Step {
        double h = 0;
        JawVector start = JawVector::Zero();
        MassPoints from, aim;  ///< p_i(q_n) carried into the frame of the step's end, a_i
        Vec3 gravity_m_s2 = upright_gravity();
        std::vector<JawMuscles::Drive> drive;
        Vec3 sling = Vec3::Zero();  ///< target of the hyoid's spring, relative to rest, m
    };
    /// Prepares a step of length h, s. `activation` has one entry per column of the rig, 0..1.
    Step begin(double h, const State& state, const Eigen::VectorXd& activation,
               const Carriage& carriage) const;
    Step begin(double h, const State& state, const Eigen::VectorXd& activation) const {
        return begin(h, state, activation, Carriage{});
    }

    /// Returns E(q), J, and writes its gradient and a positive approximation of its second derivative.
    double energy(const Step& step, const JawVector& q, JawVector& gradient,
                  JawMatrix& hessian) const;

    struct Report {
        int iterations = 0;
        double last_step_m = 0;
        bool converged = false;
    };
    /// Moves q to the minimum of E + `load`, or of E when `load` is null.
    Report minimise(const Step& step, JawVector& q, const JawLoad* load = nullptr,
                    int iterations = 40) const;

    /// Returns the state after the step, whose minimum is at q.
    State end(const Step& step, const JawVector& q) const;

    /// Makes a whole step: begin(), minimise(), end().
    Report advance(double h, const Eigen::VectorXd& activation, State& state) const;

    double kinetic_energy_j(const State& state) const;
    /// Returns the energy of weight, limits, spring of the hyoid, passive muscles and tone, J. Without active muscles, the sum of potential
    /// and kinetic energy decreases.
    double potential_energy_j(const JawVector& q) const;

    const JawJoint& joint() const { return joint_; }
    JawJoint& joint() { return joint_; }
    const JawMuscles& muscles() const { return muscles_; }
    double mass_kg() const;  ///< of the mandible

  private:
    Eigen::VectorXd relaxed() const { return Eigen::VectorXd::Zero(columns_); }
    MassPoints mass_points(const JawPose& pose, const JawVector& q) const;
    Eigen::VectorXd with_tone(const Eigen::VectorXd& activation) const;
    void balance_rest();

    JawJoint joint_;
    JawMuscles muscles_;
    MassPoints rest_points_;
    std::array<double, kMassPoints> mass_;
    Vec3 hyoid_at_full_opening_;
    int columns_;
    std::vector<int> tonic_columns_;
    JawVector rest_load_ = JawVector::Zero();  // generalised forces that stay constant
};

}  // namespace risorius::face
