// SPDX-License-Identifier: MIT
/// \file
/// Checks that solids, surfaces and curves have in common: numbers in range and symmetric tensors.
#pragma once

#include <string>

#include "risorius/core/types.h"

namespace risorius::tissue {

/// The number as messages show it, with six digits.
std::string shown(double value);
/// The point as messages show it: "[x, y, z]".
std::string shown(const Vec3& point);

/// Throws Error at `place` unless the value is finite and positive, or zero where that is allowed.
void check_range(double value, bool zero_allowed, const std::string& place);

/// Throws Error at the first entry that is negative, not finite or not symmetric. The tensor is 2 x 2 or 3 x 3.
void check_tensor(const Eigen::Ref<const Eigen::MatrixXd>& tensor, const std::string& place);

}  // namespace risorius::tissue
