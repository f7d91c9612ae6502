// SPDX-License-Identifier: MIT
/// \file
/// Small motions of a body about a state, and how explicit methods treat them: what linear theory says of stable steps.
///
///   M d'' = - K d - D d'     lambda   eigenvalues of [0 1; -M^-1 K  -M^-1 D], 1/s     z = h lambda
///   a method multiplies a motion by R(z) every step
///
/// Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I and II: stability domains.
#pragma once

#include <complex>
#include <vector>

#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"

namespace risorius::figures {

/// Eigenvalues about (x, v = 0), by central differences of the forces; dense, for some hundred free nodes at most.
std::vector<std::complex<double>> small_motions(const softbody::SoftBody& body, const Points& x);

/// |R| of the largest of the method's roots for one motion. Explicit methods of fixed step only.
double growth_per_step(solve::Method method, std::complex<double> lambda, double step_s);

/// Whether no motion grows by more than `factor` over the duration.
bool stays_bounded(solve::Method method, const std::vector<std::complex<double>>& lambdas,
                   double step_s, double duration_s, double factor);

}  // namespace risorius::figures
