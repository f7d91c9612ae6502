// SPDX-License-Identifier: MIT
/// \file
/// A chart as the two texts gnuplot draws it from.
#pragma once

#include <string>

#include "risorius/plot/chart.h"
#include "risorius/plot/detail/axis_layout.h"

namespace risorius::plot {

/// "series,x,y", a block per series with two empty lines between; empty lines are skipped by readers of CSV.
std::string chart_data(const Chart& chart);

/// Draws NAME.data.csv into NAME.svg and NAME.png of the folder it is run in.
std::string chart_script(const Chart& chart, const AxisLayout& x, const AxisLayout& y);

}  // namespace risorius::plot
