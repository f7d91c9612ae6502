// SPDX-License-Identifier: MIT
/// \file
/// The published sets of force curves (force-length, force-velocity and tendon curves) by name, and how a file chooses and
/// changes one:
///
///   "curves": "thelen2003"                                     as published
///   "curves": {"set": "zajac", "tendon_strain": 0.05}          with changed numbers; the keys are the fields of the shape
///
///   zajac         F. E. Zajac 1989 and S. L. Delp 1990            muscle_curves.h
///   thelen2003    D. G. Thelen 2003                               thelen_curves.h
///   millard2013   M. Millard, T. Uchida, A. Seth, S. L. Delp 2013   millard_curves.h
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/muscle/detail/millard_curves.h"
#include "risorius/muscle/detail/thelen_curves.h"
#include "risorius/muscle/muscle_curves.h"

namespace risorius::muscle {

/// The numbers of one set.
using CurveShape = std::variant<ZajacShape, ThelenShape, MillardShape>;

/// "zajac", "thelen2003", "millard2013".
const std::vector<std::string_view>& curve_set_names();

/// The set as published. Throws Error that names `place` for an unknown name.
CurveShape curve_set_named(const std::string& name, const std::string& place = "curves");

/// Reads a name or an object. Throws Error for all values with which make_curves() would throw.
CurveShape read_curve_shape(const JsonCursor& json);

/// Returns the force curves of a set. Throws std::invalid_argument when numbers are outside their ranges or contradict each
/// other.
MuscleCurves make_curves(const CurveShape& shape);

}  // namespace risorius::muscle
