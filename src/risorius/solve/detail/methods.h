// SPDX-License-Identifier: MIT
/// \file
/// Functions that make an integrator, one for each family of methods. The options must be those that make_integrator() has
/// checked.
#pragma once

#include <memory>

#include "risorius/solve/integrator.h"

namespace risorius::solve::detail {

std::unique_ptr<Integrator> make_euler(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_verlet(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_runge_kutta_2(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_runge_kutta_4(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_cash_karp(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_bulirsch_stoer(const IntegratorOptions& options);
/// Makes kAdamsBashforth and kAdamsMoulton.
std::unique_ptr<Integrator> make_adams(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_terzopoulos(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_implicit_euler(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_baraff_witkin(const IntegratorOptions& options);
std::unique_ptr<Integrator> make_quasi_static(const IntegratorOptions& options);

}  // namespace risorius::solve::detail
