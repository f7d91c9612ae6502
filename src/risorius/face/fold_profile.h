// SPDX-License-Identifier: MIT
/// \file
/// The form of the folds of the skin over their phase, see docs/theory/wrinkles.md. FacePose::fold_depth is their depth.
#pragma once

namespace risorius::face {

double fold_profile(double phase);  ///< P
double fold_height(double phase);   ///< h / A over the skin without folds

}  // namespace risorius::face
