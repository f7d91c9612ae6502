// SPDX-License-Identifier: MIT
/// \file
/// Dense work on the panels of a supernodal factor: column-major, `tall` rows of which the first `width` are the panel's own
/// columns. Sums run in a fixed order on every machine.
#pragma once

#include <vector>

namespace risorius::solve::detail {

/// C = A B^T, m x n from m x k and n x k; only what is on and below the diagonal of C's first n rows is needed and more may be
/// written. C has m rows.
void product(const double* a, int a_stride, const double* b, int b_stride, int m, int n, int k,
             double* c);

/// The panel's columns of L, in place. False when a pivot is not positive. `scratch` is resized.
bool factorise_panel(double* panel, int tall, int width, std::vector<double>& scratch);

/// w holds the right-hand side of the panel's columns and zeros below: afterwards their solution and what they take from the
/// rows below.
void eliminate(const double* panel, int tall, int width, double* w);

/// w holds the right-hand side of the panel's columns and the solution of the rows below: afterwards all is solution.
void substitute(const double* panel, int tall, int width, double* w);

}  // namespace risorius::solve::detail
