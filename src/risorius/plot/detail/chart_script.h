// SPDX-License-Identifier: MIT
/// \file
/// Makes the two texts from which gnuplot draws a chart.
#pragma once

#include <string>

#include "risorius/plot/chart.h"
#include "risorius/plot/detail/axis_layout.h"

namespace risorius::plot {

/// Returns the data: lines "series,x,y" in one block per series, with two empty lines between blocks. Readers of CSV skip the
/// empty lines.
std::string chart_data(const Chart& chart);

/// Returns a script that draws NAME.data.csv into NAME.svg and NAME.png, in the folder in which it runs.
std::string chart_script(const Chart& chart, const AxisLayout& x, const AxisLayout& y);

}  // namespace risorius::plot
