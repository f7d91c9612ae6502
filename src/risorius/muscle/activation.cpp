// SPDX-License-Identifier: MIT
#include "risorius/muscle/activation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace risorius::muscle {

namespace {

constexpr double kInnerStep_s = 0.25e-3;
constexpr double kPiece_s = 1e-3;

/// Number of equal pieces of at most `longest`. A length that is a multiple of it, up to rounding, gets no extra piece.
int piece_count(double length, double longest) {
    return std::max(1, static_cast<int>(std::ceil(length / longest - 1e-6)));
}

/// 1 / r, s.
double time_constant(double a, double u, const ActivationTimes& times, const ActivationLaw& law) {
    const double slope = 0.5 + 1.5 * std::abs(a);
    const double grow = times.t_act_s * slope, fall = times.t_deact_s / slope;
    if (law.form == ActivationLaw::Form::kThelen2003) {
        const bool grows = u > a ? a >= 0 : a <= 0;
        return grows ? grow : fall;
    }
    const double outward = a < 0 || (a == 0 && u < 0) ? a - u : u - a;
    const double f = 0.5 + 0.5 * std::tanh(law.steepness * outward);
    return 1 / (f / grow + (1 - f) / fall);
}

}  // namespace

double activation_rate(double a, double u, const ActivationTimes& times, const ActivationLaw& law) {
    return (u - a) / time_constant(a, u, times, law);
}

double advance_activation(double a, double u, const ActivationTimes& times, double h,
                          const ActivationLaw& law) {
    if (h <= 0) return a;
    const int steps = piece_count(h, kInnerStep_s);
    const double step = h / steps;
    for (int i = 0; i < steps && a != u; ++i) {
        a += (u - a) * -std::expm1(-step / time_constant(a, u, times, law));
    }
    return a;
}

ActivationDynamics::ActivationDynamics(Eigen::VectorXd t_act_s, Eigen::VectorXd t_deact_s,
                                       const ActivationLaw& law)
    : t_act_s_(std::move(t_act_s)),
      t_deact_s_(std::move(t_deact_s)),
      activation_(Eigen::VectorXd::Zero(t_act_s_.size())),
      law_(law) {
    assert(t_act_s_.size() == t_deact_s_.size());
}

void ActivationDynamics::set_activation(const Eigen::VectorXd& activation) {
    assert(activation.size() == activation_.size());
    activation_ = activation;
}

void ActivationDynamics::advance(const Eigen::VectorXd& excitation, const Eigen::VectorXd& direct,
                                 double h) {
    assert(excitation.size() == activation_.size());
    for (Eigen::Index i = 0; i < activation_.size(); ++i) {
        if (direct.size() > 0 && !std::isnan(direct[i]))
            activation_[i] = direct[i];
        else
            activation_[i] = advance_activation(activation_[i], excitation[i],
                                                {t_act_s_[i], t_deact_s_[i]}, h, law_);
    }
}

void ActivationDynamics::advance(const ExcitationAt& excitation_at, const Eigen::VectorXd& direct,
                                 double from_s, double to_s) {
    if (to_s <= from_s) return;
    const int pieces = piece_count(to_s - from_s, kPiece_s);
    const double piece = (to_s - from_s) / pieces;
    for (int i = 0; i < pieces; ++i)
        advance(excitation_at(from_s + (i + 0.5) * piece), direct, piece);
}

}  // namespace risorius::muscle
