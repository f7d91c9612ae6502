// SPDX-License-Identifier: MIT
/// \file
/// The manner of an expression: how fast it comes and goes when it is posed, spontaneous, or a micro-expression.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::track {

/// Times of an expression, s.
struct ExpressionTimes {
    double onset_s = 0;   ///< until the apex, [0, 60]
    double hold_s = 0;    ///< at the apex, [0, 3600]
    double offset_s = 0;  ///< from the apex back to rest, [0, 60]
};

/// A manner is either a factor on the usual times of each expression, or has times of its own.
struct Manner {
    std::string name;
    std::string source;  ///< who measured the times
    bool is_factor = false;
    ExpressionTimes factor;  ///< of the usual times, a ratio each; used if is_factor
    ExpressionTimes others;  ///< of expressions that are not listed
    std::vector<std::pair<std::string, ExpressionTimes>> listed;  ///< by the name of the expression

    /// Returns the times of the expression with this name, which usually takes `usual`.
    ExpressionTimes times(const std::string& expression, const ExpressionTimes& usual) const;
};

/// Reads one manner of expressions.json. Throws Error for values outside their ranges, and for a manner that has both a factor and
/// times, or neither.
Manner read_manner(const JsonCursor& json, const std::string& name);

}  // namespace risorius::track
