// SPDX-License-Identifier: MIT
/// \file
/// The ends of an axis and the numbers along it.
#pragma once

#include <string>
#include <vector>

#include "risorius/plot/chart.h"

namespace risorius::plot {

struct Tic {
    double at;
    std::string label;  ///< empty for a minor one
};

struct AxisLayout {
    double low = 0, high = 1;
    std::vector<Tic> tics;  ///< of logarithmic axes; linear ones are left to gnuplot
};

/// The range over finite values. Throws Error, naming `place`, for values that a logarithmic axis does not have, a range
/// upside down, or no finite value and no range.
AxisLayout lay_out(const Axis& axis, const std::vector<double>& values, const std::string& place);

/// "3^3" -> "3³": powers raised, line breaks and other control characters as spaces.
std::string typeset(const std::string& text);

}  // namespace risorius::plot
