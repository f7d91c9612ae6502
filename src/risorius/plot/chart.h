// SPDX-License-Identifier: MIT
/// \file
/// The description of a chart: curves over two axes, in the style of journals. plot::write_chart draws it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace risorius::plot {

/// How a series is drawn.
enum class Mark { kLine, kDashed, kPoints, kLinePoints };

/// One curve. x and y have the same length.
struct Series {
    std::string label;  ///< name in the key of the chart; empty: the series is not in the key
    std::vector<double> x = {}, y = {};
    Mark mark = Mark::kLine;
    /// Index of the colour in the palette; -1: the next colour. Series of equal colour belong together.
    int colour = -1;
};

/// A range that is drawn behind the curves, for published values.
struct Band {
    std::string label;
    double low = 0, high = 0;  ///< on the y axis
};

/// One axis of a chart.
struct Axis {
    std::string label = {};  ///< quantity and unit: "time (s)"
    bool logarithmic = false;
    std::optional<std::pair<double, double>> range = {};  ///< none: the range of the data
    /// Names at places of the axis, in place of numbers. Not for logarithmic axes.
    std::vector<std::pair<double, std::string>> names = {};
};

/// The whole chart.
struct Chart {
    std::string name;        ///< name of its files: letters, digits, "_" and "-"
    std::string title = {};  ///< one line above the chart
    Axis x = {}, y = {};
    std::vector<Series> series = {};
    std::vector<Band> bands = {};
};

}  // namespace risorius::plot
