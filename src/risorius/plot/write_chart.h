// SPDX-License-Identifier: MIT
/// \file
/// Draws a chart as NAME.svg and NAME.png, sharp enough for print. The sources of the chart are kept beside them, so that it
/// can be drawn again in another style: NAME.gp, a script for gnuplot, and NAME.data.csv (series, x, y).
///
/// Colours are those of Okabe and Ito 2008, which people with any colour vision can distinguish.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/plot/chart.h"

namespace risorius::plot {

/// The program that draws.
struct ChartWriter {
    std::string gnuplot = "gnuplot";  ///< the program; it is searched in PATH when it has no slash
};

/// Writes the files into `folder`, which must exist, and returns their names. The same chart gives the same bytes.
///
/// Values that are not finite leave a gap. Labels are plain text, except that powers such as "3^3" and "m s^-2" are raised.
/// Throws Error for a chart that cannot be drawn (no name, series of unequal length, nothing finite, a value of 0 or less on a
/// logarithmic axis). Throws RunError when gnuplot is missing or fails, or when the folder cannot be written.
std::vector<std::string> write_chart(const Chart& chart, const std::filesystem::path& folder,
                                     const ChartWriter& writer = {});

}  // namespace risorius::plot
