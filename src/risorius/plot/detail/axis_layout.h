// SPDX-License-Identifier: MIT
/// \file
/// Computes the ends of an axis and the numbers along it.
#pragma once

#include <string>
#include <vector>

#include "risorius/plot/chart.h"

namespace risorius::plot {

struct Tic {
    double at;
    std::string label;  ///< empty for a minor tic
};

struct AxisLayout {
    double low = 0, high = 1;
    std::vector<Tic>
        tics;  ///< of logarithmic axes and those with names; gnuplot chooses the others
};

/// The range of the finite values, or the axis' own range. Throws Error that names `place`: for values that a logarithmic axis
/// cannot show, for a range whose ends are in the wrong order, and when there is neither a finite value nor a range.
AxisLayout lay_out(const Axis& axis, const std::vector<double>& values, const std::string& place);

/// Returns a label in which powers are raised, "3³" for "3^3". Line breaks and other control characters become spaces.
std::string typeset(const std::string& text);

}  // namespace risorius::plot
