// SPDX-License-Identifier: MIT
/// \file
/// Activation dynamics: how fast the activation of a muscle follows its neural excitation.
///
///   u   neural excitation, fraction of the maximum          [min, 1]
///   a   activation, fraction of the maximum                 [min, 1]
///   da/dt = (u - a) r
///   thelen2003   r = 1 / (t_act s)                  while a moves away from 0,      s = 0.5 + 1.5 |a|
///                r = s / t_deact                    while it returns
///   smooth       r = f / (t_act s) + (1 - f) s / t_deact,   f = 1/2 + 1/2 tanh(b (u - a)),   b the steepness
///
/// min is 0, or negative for muscles whose resting tone can be reduced (levator palpebrae superioris in a blink). Below 0 the
/// laws are mirrored: a moves away from 0 when it falls. t_act and t_deact are the time constants, s.
///
/// The rate r of the smooth law is continuous at u = a. Its steepness b was published as 0.1. With that value f hardly differs
/// from 1/2, and a falls to 0.1 within 37 ms instead of Thelen's 94 ms (t_act = 10 ms, t_deact = 40 ms). OpenSim recommends 10
/// instead, which is the default here. Then a falls to 0.1 within 82 ms. It reaches 0.5 after 6.4 ms from below and after 17.9
/// ms from above, as in Thelen's law.
///
/// The integration step a += (u - a)(1 - exp(-h r)), with r at the start of the step, moves a towards u and never beyond it,
/// for any h. Steps h are at most 0.25 ms long, so that the onset of activation does not depend on the frame rate.
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

/// da/dt, 1/s, for the activation a and the excitation u.
double activation_rate(double a, double u, const ActivationTimes& times,
                       const ActivationLaw& law = {});

/// Returns the activation after the excitation u has acted on the activation a for h seconds.
double advance_activation(double a, double u, const ActivationTimes& times, double h,
                          const ActivationLaw& law = {});

/// The activations of all muscles of a face, one entry (column) each. They start at zero.
class ActivationDynamics {
  public:
    /// `t_act_s` and `t_deact_s`: time constants of each muscle, s, > 0.
    ActivationDynamics(Eigen::VectorXd t_act_s, Eigen::VectorXd t_deact_s,
                       const ActivationLaw& law = {});

    const Eigen::VectorXd& activation() const { return activation_; }
    void set_activation(const Eigen::VectorXd& activation);

    /// Applies `excitation` for h seconds. Where `direct` is not NaN, it is the new activation of the muscle instead; it may be
    /// empty.
    void advance(const Eigen::VectorXd& excitation, const Eigen::VectorXd& direct, double h);

    /// Applies an excitation that changes in time, from `from_s` to `to_s`. This interval is cut into equal parts of at most 1
    /// ms, and the excitation in a part is the one at the middle of the part. `direct` as above.
    using ExcitationAt = std::function<const Eigen::VectorXd&(double t_s)>;
    void advance(const ExcitationAt& excitation_at, const Eigen::VectorXd& direct, double from_s,
                 double to_s);

  private:
    Eigen::VectorXd t_act_s_, t_deact_s_, activation_;
    ActivationLaw law_;
};

}  // namespace risorius::muscle
