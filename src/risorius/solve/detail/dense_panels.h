// SPDX-License-Identifier: MIT
/// \file
/// Dense operations on the panels of a supernodal factor. A panel has `tall` rows and `width` columns and is column-major. Its
/// first `width` rows are the diagonal block of its columns. Sums run in a fixed order on every machine.
#pragma once

#include <vector>

namespace risorius::solve::detail {

/// Computes C = A B^T, where A is m x k, B is n x k, and C is m x n and stored with m rows. The entries above the diagonal of
/// the first n rows of C are not used and may be wrong.
void product(const double* a, int a_stride, const double* b, int b_stride, int m, int n, int k,
             double* c);

/// Computes the panel's columns of L in place. Returns false when a pivot is not positive. `scratch` is resized as needed.
bool factorise_panel(double* panel, int tall, int width, std::vector<double>& scratch);

/// Forward substitution with one panel. On entry, w has the right-hand side in the first `width` rows and zeros below. On
/// return, it has the solution in these rows, and below them the numbers to subtract from the right-hand side of the other
/// rows.
void eliminate(const double* panel, int tall, int width, double* w);

/// Backward substitution with one panel. On entry, w has the right-hand side in the first `width` rows and the solution in the
/// rows below. On return, it has the solution in all rows.
void substitute(const double* panel, int tall, int width, double* w);

}  // namespace risorius::solve::detail
