// SPDX-License-Identifier: MIT
/// \file
/// What the checks of solids, surfaces and curves share: numbers in range and tensors that are symmetric.
#pragma once

#include <string>

#include "risorius/core/types.h"

namespace risorius::tissue {

/// As messages show it: six digits.
std::string shown(double value);
/// "[x, y, z]"
std::string shown(const Vec3& point);

/// Throws Error at `place` unless finite and positive, or zero where that is allowed.
void check_range(double value, bool zero_allowed, const std::string& place);

/// Throws Error at the first entry that is negative, not finite or unlike its mirror image. 2 x 2 or 3 x 3.
void check_tensor(const Eigen::Ref<const Eigen::MatrixXd>& tensor, const std::string& place);

}  // namespace risorius::tissue
