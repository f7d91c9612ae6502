// SPDX-License-Identifier: MIT
/// \file
/// A readout that fits a person: it reads what is wanted of the expressions that the person shows, and is changed as little as possible.
///
///   W   readout, channels x numbers      X   what the person shows, numbers x expressions      R   wanted, channels x expressions
///   W'  = W + (R - W X) (X^T X)^-1 X^T, the least |W' - W|^2 with W' X = R
#pragma once

#include "risorius/core/types.h"

namespace risorius::perform {

/// `x` must have independent columns.
Eigen::MatrixXd corrected_readout(const Eigen::MatrixXd& w, const Eigen::MatrixXd& x,
                                  const Eigen::MatrixXd& wanted);

}  // namespace risorius::perform
