// SPDX-License-Identifier: MIT
/// \file
/// A chart as described: curves over two axes, in the way journals print them. plot::write_chart draws it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace risorius::plot {

enum class Mark { kLine, kDashed, kPoints, kLinePoints };

struct Series {
    std::string label;  ///< in the key; empty leaves it out
    std::vector<double> x = {}, y = {};
    Mark mark = Mark::kLine;
    int colour = -1;  ///< of the palette, -1 = the next one; series of equal colour belong together
};

/// A range drawn behind the curves: what was published.
struct Band {
    std::string label;
    double low = 0, high = 0;  ///< on the y axis
};

struct Axis {
    std::string label = {};  ///< quantity and unit: "time (s)"
    bool logarithmic = false;
    std::optional<std::pair<double, double>> range = {};  ///< of the data when not given
};

struct Chart {
    std::string name;        ///< of its files
    std::string title = {};  ///< one line above
    Axis x = {}, y = {};
    std::vector<Series> series = {};
    std::vector<Band> bands = {};
};

}  // namespace risorius::plot
