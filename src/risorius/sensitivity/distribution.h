// SPDX-License-Identifier: MIT
/// \file
/// The distribution of a number that is not known exactly.
///
///   uniform      [low, high]
///   log_uniform  [low, high]: the logarithm is uniform; low > 0
///   normal       [mean, standard deviation]
///   log_normal   [median, factor]: two thirds of the values lie within median / factor and median * factor; factor > 1
#pragma once

#include <string>

#include "risorius/core/json_cursor.h"

namespace risorius::sensitivity {

struct Distribution {
    enum class Kind { kUniform, kLogUniform, kNormal, kLogNormal } kind = Kind::kUniform;
    double first = 0, second = 1;  ///< the two numbers of the table above

    /// Returns the value below which the fraction `u` of the distribution lies, 0 < u < 1.
    double quantile(double u) const;
    /// "log_uniform 0.5 to 2"
    std::string text() const;
};

/// Reads {"log_uniform": [0.5, 2]}. Throws Error.
Distribution read_distribution(const JsonCursor& json);

/// Returns z with P(Z < z) = u for a standard normal Z, 0 < u < 1, to 1e-14.
double normal_quantile(double u);

}  // namespace risorius::sensitivity
