// SPDX-License-Identifier: MIT
/// \file
/// Dense operations on the panels of a supernodal factor. A panel is column-major with `tall` rows; the first `width` rows
/// belong to the panel's own columns. Sums run in a fixed order on every machine.
#pragma once

#include <vector>

namespace risorius::solve::detail {

/// C = A B^T, m x n from m x k and n x k. Entries above the diagonal of the first n rows of C are
/// not needed and need not be correct. C has m rows.
void product(const double* a, int a_stride, const double* b, int b_stride, int m, int n, int k,
             double* c);

/// Computes the panel's columns of L in place. Returns false when a pivot is not positive. `scratch` is resized.
bool factorise_panel(double* panel, int tall, int width, std::vector<double>& scratch);

/// On entry, w has the right-hand side of the panel's columns and zeros below. On return, it has their solution, and below what
/// they subtract from the other rows.
void eliminate(const double* panel, int tall, int width, double* w);

/// On entry, w has the right-hand side of the panel's columns and the solution of the rows below. On return, all of it is
/// solution.
void substitute(const double* panel, int tall, int width, double* w);

}  // namespace risorius::solve::detail
