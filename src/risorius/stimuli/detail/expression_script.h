// SPDX-License-Identifier: MIT
/// \file
/// The expression in a script alone: its expressions and action units in a healthy face, without anything else that moves.
#pragma once

#include <optional>

#include "risorius/core/json_cursor.h"

namespace risorius::stimuli {

/// Returns the script with nothing but its expressions and units; none when it has neither, or when all are 0.
std::optional<Json> expression_alone(Json script);

/// Does the same for a script that is only used for the settled face. The course of a single expression then does not matter, and it is
/// the same in all such scripts.
std::optional<Json> expression_settled(const Json& script);

/// Does the same, with all expressions and units scaled so that the largest is 1.
std::optional<Json> expression_at_full_intensity(const Json& script);

}  // namespace risorius::stimuli
