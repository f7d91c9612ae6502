// SPDX-License-Identifier: MIT
/// \file
/// A chart as the two texts that gnuplot draws it from.
#pragma once

#include <string>

#include "risorius/plot/chart.h"
#include "risorius/plot/detail/axis_layout.h"

namespace risorius::plot {

/// "series,x,y": one block per series, with two empty lines between blocks. Readers of CSV skip the empty lines.
std::string chart_data(const Chart& chart);

/// A script that draws NAME.data.csv into NAME.svg and NAME.png, in the folder in which it runs.
std::string chart_script(const Chart& chart, const AxisLayout& x, const AxisLayout& y);

}  // namespace risorius::plot
