// SPDX-License-Identifier: MIT
/// \file
/// Small motions of a body about a state, and the linear stability of explicit time-stepping methods for them. d is the
/// displacement from that state, M the mass matrix, K the stiffness, D the damping and h the time step.
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

/// Returns the eigenvalues lambda, 1/s, about the positions x at velocity 0. K and D are central differences of the forces. The
/// matrices are dense, so the body may have a few hundred free nodes at most.
std::vector<std::complex<double>> small_motions(const softbody::SoftBody& body, const Points& x);

/// Returns the factor |R(z)| by which the method makes a mode grow in every step. For a multistep method, it is the largest
/// magnitude of the roots. `method`: an explicit one with a fixed step.
double growth_per_step(solve::Method method, std::complex<double> lambda, double step_s);

/// Returns whether every mode grows by no more than `factor` over the duration.
bool stays_bounded(solve::Method method, const std::vector<std::complex<double>>& lambdas,
                   double step_s, double duration_s, double factor);

}  // namespace risorius::figures
