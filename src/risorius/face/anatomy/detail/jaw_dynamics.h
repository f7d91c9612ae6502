// SPDX-License-Identifier: MIT
/// \file
/// The dynamic jaw: the mandible as a rigid body on two condyles, and the hyoid bone, both moved by their muscles.
///
///   q     coordinates (jaw_joint.h)     p_i  six points that carry the mass and inertia of the mandible, and the hyoid
/// A step of length h minimises over q
///   E = sum m_i |p_i(q) - a_i|^2 / (2 h^2) + |q - q_n|^2_D / (2 h) + muscles + limits + hyoid sling + weight + tone,
///   a_i = p_i(q_n) + h v_i,   v_i after the step = (p_i(q) - p_i(q_n)) / h
/// This is implicit Euler, of first order. The tissue uses BDF2 (tissue_motion.h), and so has its own h in the common solve. The minimum
/// is found by Newton's method with a positive second derivative and a line search. The tissue acts through `JawLoad`.
///
/// At rest the closing muscles have a constant tone (activation 0.012). It carries the weight of the jaw and presses the molars lightly
/// together. Its pull along the slides and the passive tension at rest are assumed to be in balance with the capsules. So rest is an exact
/// equilibrium, and a jaw that is released closes.
/// The hyoid must be held against geniohyoid, mylohyoid and digastric. The infrahyoid muscles are not in the muscle table; a spring takes
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

/// A quadratic energy of the jaw about `at`, for forces from outside.
struct JawLoad {
    JawVector at = JawVector::Zero();
    JawVector gradient = JawVector::Zero();   ///< N
    JawMatrix stiffness = JawMatrix::Zero();  ///< N/m, positive
};

class JawDynamics {
  public:
    /// Muscles named in `solids` keep only their tone here; solids pull in their place.
    JawDynamics(const rig::Head& head, const rig::RigDescription& rig,
                const std::set<std::string>& solids = {});

    static constexpr int kMassPoints = 7;  ///< the last one is the hyoid
    using MassPoints = std::array<Vec3, kMassPoints>;
    struct State {
        JawVector q = JawVector::Zero();
        MassPoints velocity = still();  ///< through space, in the frame of the head, m/s
    };
    static MassPoints still();

    /// Motion of the head as seen by the jaw: where points at rest in space lie at the end of the step, and gravity in the head frame.
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
    /// `activation` per column of the rig.
    Step begin(double h, const State& state, const Eigen::VectorXd& activation,
               const Carriage& carriage) const;
    Step begin(double h, const State& state, const Eigen::VectorXd& activation) const {
        return begin(h, state, activation, Carriage{});
    }

    /// E(q); writes its gradient and a positive second derivative.
    double energy(const Step& step, const JawVector& q, JawVector& gradient,
                  JawMatrix& hessian) const;

    struct Report {
        int iterations = 0;
        double last_step_m = 0;
        bool converged = false;
    };
    /// Moves q to the minimum of E, plus `load` when given.
    Report minimise(const Step& step, JawVector& q, const JawLoad* load = nullptr,
                    int iterations = 40) const;

    State end(const Step& step, const JawVector& q) const;

    /// begin, minimise, end.
    Report advance(double h, const Eigen::VectorXd& activation, State& state) const;

    double kinetic_energy_j(const State& state) const;
    /// Energy of weight, limits, spring of the hyoid, passive muscles and tone, J. Without active muscles, its sum with the kinetic energy falls.
    double potential_energy_j(const JawVector& q) const;

    const JawJoint& joint() const { return joint_; }
    JawJoint& joint() { return joint_; }
    const JawMuscles& muscles() const { return muscles_; }
    double mass_kg() const;

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
