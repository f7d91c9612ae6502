// SPDX-License-Identifier: MIT
/// \file
/// Draws a chart as NAME.svg and NAME.png, sharp enough for print, and leaves what it was drawn from beside them:
/// NAME.gp, a script for gnuplot, and NAME.data.csv (series, x, y), so that it can be drawn again in another style.
///
/// Colours are those of Okabe and Ito 2008, which people with any colour vision tell apart.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/plot/chart.h"

namespace risorius::plot {

struct ChartWriter {
    std::string gnuplot = "gnuplot";  ///< the program, looked for in PATH when it has no slash
};

/// The names of the files written into `folder`, which must exist. The same chart gives the same bytes.
///
/// Values that are not finite leave a gap. Labels are plain text, but for powers: "3^3" and "m s^-2" are raised.
/// Throws Error for a chart that cannot be drawn (no name, series of unequal length, nothing finite, a value of
/// 0 or less on a logarithmic axis) and RunError when gnuplot is missing or fails or the folder cannot be written.
std::vector<std::string> write_chart(const Chart& chart, const std::filesystem::path& folder,
                                     const ChartWriter& writer = {});

}  // namespace risorius::plot
