// SPDX-License-Identifier: MIT
/// \file
/// From excitation to activation: how fast the force capacity of a muscle follows its neural drive.
///
///   u   neural excitation, fraction of the maximum          [min, 1]
///   a   activation, fraction of the maximum                 [min, 1]
///   da/dt = (u - a) r
///   thelen2003   r = 1 / (t_act s)                  while a moves away from 0,      s = 0.5 + 1.5 |a|
///                r = s / t_deact                    while it returns
///   smooth       r = f / (t_act s) + (1 - f) s / t_deact,   f = 1/2 + 1/2 tanh(b (u - a)),   b the steepness
///
/// The smooth law has no jump between growing and returning. Its steepness was published as 0.1. With that value f hardly
/// differs from 1/2, and a falls to 0.1 within 37 ms instead of Thelen's 94 ms (t_act = 10 ms, t_deact = 40 ms). OpenSim
/// recommends the correction to 10. Then the fall takes 82 ms, and reaching 0.5 takes 6.4 ms upwards and 17.9 ms downwards, as
/// in Thelen's law.
///
/// The step a += (u - a)(1 - exp(-h r)) is monotone and cannot overshoot for any h. Steps are at most 0.25 ms long, so that
/// onset does not depend on the frame rate. Muscles whose resting tone can be reduced (u < 0: levator palpebrae superioris in a
/// blink) follow the same law on the other side of 0.
///
/// Sources: Thelen 2003, J. Biomech. Eng. 125(1), 70-77; De Groote et al. 2016, Ann. Biomed. Eng. 44(10), 2922-2936, eqs 1 and
/// 2; OpenSim issue 3990 and pull request 4007 (A. van den Bogert, N. Bianco 2025) for the steepness.
#pragma once

#include <functional>

#include "risorius/core/types.h"

namespace risorius::muscle {

/// Time constants of activation and deactivation, s, > 0.
struct ActivationTimes {
    double t_act_s = 0.010;
    double t_deact_s = 0.040;
};

/// Which law of activation is used.
struct ActivationLaw {
    enum class Form { kThelen2003, kSmooth };
    Form form = Form::kThelen2003;
    double steepness = 10;  ///< b, of the smooth form                   (0, inf)
};

/// da/dt, 1/s.
double activation_rate(double a, double u, const ActivationTimes& times,
                       const ActivationLaw& law = {});

/// Activation after excitation u has acted for h seconds.
double advance_activation(double a, double u, const ActivationTimes& times, double h,
                          const ActivationLaw& law = {});

/// The activations of all muscle columns of a face. They start at zero.
class ActivationDynamics {
  public:
    /// Time constants for each column, s, > 0.
    ActivationDynamics(Eigen::VectorXd t_act_s, Eigen::VectorXd t_deact_s,
                       const ActivationLaw& law = {});

    const Eigen::VectorXd& activation() const { return activation_; }
    void set_activation(const Eigen::VectorXd& activation);

    /// Applies `excitation` for h seconds. `direct` sets the activation of the columns where it is not NaN; it may be empty.
    void advance(const Eigen::VectorXd& excitation, const Eigen::VectorXd& direct, double h);

    /// Follows a changing excitation. It is evaluated at the middle of substeps of at most 1 ms between the two times.
    using ExcitationAt = std::function<const Eigen::VectorXd&(double t_s)>;
    void advance(const ExcitationAt& excitation_at, const Eigen::VectorXd& direct, double from_s,
                 double to_s);

  private:
    Eigen::VectorXd t_act_s_, t_deact_s_, activation_;
    ActivationLaw law_;
};

}  // namespace risorius::muscle
