// SPDX-License-Identifier: MIT
/// \file
/// Excitation to activation: how fast a muscle's force capacity follows its neural drive.
///
///   u   neural excitation, ratio of the greatest          [min, 1]
///   a   activation, ratio of the greatest                 [min, 1]
///   da/dt = (u - a) r
///   thelen2003   r = 1 / (t_act s)                  while a grows away from 0,      s = 0.5 + 1.5 |a|
///                r = s / t_deact                    while it returns
///   smooth       r = f / (t_act s) + (1 - f) s / t_deact,   f = 1/2 + 1/2 tanh(b (u - a)),   b the steepness
///
/// The smooth law has no jump between growing and returning. Its steepness was published as 0.1, with which f hardly leaves
/// 1/2 and a falls to 0.1 within 37 ms instead of 94 (t_act = 10, t_deact = 40 ms); at 10, the correction OpenSim
/// recommends, it is 82 ms, and the way to 0.5 takes the same 6.4 ms up and 17.9 ms down as Thelen's law.
///
/// The step a += (u - a)(1 - exp(-h r)) is monotone and cannot overshoot whatever h is. Steps are cut to at most
/// 0.25 ms, so that onset does not depend on the frame rate. Muscles whose resting tone can be taken away (u < 0: levator
/// palpebrae superioris in a blink) follow the same law on the other side of 0.
/// Sources: Thelen 2003, J. Biomech. Eng. 125(1), 70-77; De Groote et al. 2016, Ann. Biomed. Eng. 44(10), 2922-2936,
/// eqs 1 and 2; OpenSim issue 3990 and pull request 4007 (A. van den Bogert, N. Bianco 2025) for the steepness.
#pragma once

#include <functional>

#include "risorius/core/types.h"

namespace risorius::muscle {

struct ActivationTimes {
    double t_act_s = 0.010;
    double t_deact_s = 0.040;
};

struct ActivationLaw {
    enum class Form { kThelen2003, kSmooth };
    Form form = Form::kThelen2003;
    double steepness = 10;  ///< b, of the smooth form                   (0, inf)
};

/// da/dt, 1/s.
double activation_rate(double a, double u, const ActivationTimes& times,
                       const ActivationLaw& law = {});

/// Activation after excitation u has been held for h seconds.
double advance_activation(double a, double u, const ActivationTimes& times, double h,
                          const ActivationLaw& law = {});

/// The same for every column of a face; starts at rest.
class ActivationDynamics {
  public:
    /// Time constants per column, s, > 0.
    ActivationDynamics(Eigen::VectorXd t_act_s, Eigen::VectorXd t_deact_s,
                       const ActivationLaw& law = {});

    const Eigen::VectorXd& activation() const { return activation_; }
    void set_activation(const Eigen::VectorXd& activation);

    /// Holds `excitation` for h seconds. `direct` sets the activation of the columns where it is not NaN; it may be empty.
    void advance(const Eigen::VectorXd& excitation, const Eigen::VectorXd& direct, double h);

    /// Follows an excitation that changes: asks for it at the middle of every piece of at most 1 ms between the two times.
    using ExcitationAt = std::function<const Eigen::VectorXd&(double t_s)>;
    void advance(const ExcitationAt& excitation_at, const Eigen::VectorXd& direct, double from_s,
                 double to_s);

  private:
    Eigen::VectorXd t_act_s_, t_deact_s_, activation_;
    ActivationLaw law_;
};

}  // namespace risorius::muscle
