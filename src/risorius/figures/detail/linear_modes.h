// SPDX-License-Identifier: MIT
/// \file
/// Small motions of a body about a state, and the linear stability of explicit methods for them.
///
///   M d'' = - K d - D d'     lambda   eigenvalues of [0 1; -M^-1 K  -M^-1 D], 1/s     z = h lambda
///   a method multiplies a mode by R(z) in every step
///
/// Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I and II: stability domains.
#pragma once

#include <complex>
#include <vector>

#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"

namespace risorius::figures {

/// Eigenvalues lambda about (x, v = 0), by central differences of the forces. Dense: for a few hundred free nodes at most.
std::vector<std::complex<double>> small_motions(const softbody::SoftBody& body, const Points& x);

/// Growth factor per step: the largest |root| of the method for one mode. Only explicit methods with a fixed step.
double growth_per_step(solve::Method method, std::complex<double> lambda, double step_s);

/// Whether no mode grows by more than `factor` over the duration.
bool stays_bounded(solve::Method method, const std::vector<std::complex<double>>& lambdas,
                   double step_s, double duration_s, double factor);

}  // namespace risorius::figures
