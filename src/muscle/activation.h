// Excitation to activation: how fast a muscle's force capacity follows its neural drive.
//
//   u   neural excitation, ratio of the greatest          [min, 1]
//   a   activation, ratio of the greatest                 [min, 1]
//   da/dt = (u - a) / tau,   tau = t_act (0.5 + 1.5 |a|)    while a grows away from 0
//                            tau = t_deact / (0.5 + 1.5 |a|)  while it returns
//
// The step a += (u - a)(1 - exp(-h / tau)) is monotone and cannot overshoot whatever h is. Steps are cut to at most
// 0.25 ms, so that onset does not depend on the frame rate. Muscles whose resting tone can be taken away (u < 0: levator
// palpebrae superioris in a blink) follow the same law on the other side of 0.
// Source: Thelen 2003, J. Biomech. Eng. 125(1), 70-77.
#pragma once

#include <functional>

#include "core/types.h"

namespace risorius::muscle {

struct ActivationTimes {
    double t_act_s = 0.010;
    double t_deact_s = 0.040;
};

/// Activation after excitation u has been held for h seconds.
double advance_activation(double a, double u, const ActivationTimes& times, double h);

/// The same for every column of a face; starts at rest.
class ActivationDynamics {
  public:
    /// Time constants per column, s, > 0.
    ActivationDynamics(Eigen::VectorXd t_act_s, Eigen::VectorXd t_deact_s);

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
};

}  // namespace risorius::muscle
