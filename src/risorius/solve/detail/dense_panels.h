// SPDX-License-Identifier: MIT
/// \file
/// Dense operations on the panels of a supernodal factor. A panel has `tall` rows and `width` columns and is column-major. Its
/// first `width` rows are the diagonal block of its columns. Sums run in a fixed order on every machine.
#pragma once

#include <vector>

namespace risorius::solve::detail {

/// Entries that must be readable after the last one of a panel, and after the `tall` rows of w. They must be finite; no result depends
/// on them.
inline constexpr int kReadBeyond = 16;

/// Returns the number of rows that C has in memory when m of them are wanted.
template <class Real>
int stored_rows(int m);

/// Computes C = A B^T, where A is m x k, B is n x k, and C is m x n and stored with stored_rows(m) rows. The entries above the
/// diagonal of the first n rows of C, and the rows from m on, are not used and may be wrong.
template <class Real>
void product(const Real* a, int a_stride, const Real* b, int b_stride, int m, int n, int k,
             Real* c);

/// Computes the panel's columns of L in place. Returns false when a pivot is not positive. `scratch` is resized as needed. At least
/// kReadBeyond entries follow the panel.
template <class Real>
bool factorise_panel(Real* panel, int tall, int width, std::vector<Real>& scratch);

/// Forward substitution with one panel. On entry, w has the right-hand side in the first `width` rows and zeros below. On
/// return, it has the solution in these rows, and below them the numbers to subtract from the right-hand side of the other
/// rows. kReadBeyond rows of w after them are overwritten.
template <class Real>
void eliminate(const Real* panel, int tall, int width, Real* w);

/// Backward substitution with one panel. On entry, w has the right-hand side in the first `width` rows and the solution in the
/// rows below. On return, it has the solution in all rows. kReadBeyond rows of w after them are overwritten.
template <class Real>
void substitute(const Real* panel, int tall, int width, Real* w);

}  // namespace risorius::solve::detail
