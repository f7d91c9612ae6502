// SPDX-License-Identifier: MIT
/// \file
/// An HTML page of figures: published and measured values side by side, pictures and charts, and the reasons for differences.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/figures/detail/figure_files.h"
#include "risorius/figures/detail/figure_result.h"
#include "risorius/figures/registry.h"

namespace risorius::figures {

/// A figure that has been run and written.
struct ShownFigure {
    figures::FigureResult result;
    FigureFiles files;
    std::string folder;     ///< path from the page to the folder of its files, "" or "9b/"
    std::string readme;     ///< Markdown; empty when there is none
    double run_time_s = 0;  ///< approximate, from the list of figures; 0 when unknown
    figures::Origin origin = figures::Origin::kOwn;
    /// File name of a picture of the published figure; empty when there is none
    std::string published;
};

/// Returns the complete HTML page.
std::string figure_page(const std::vector<ShownFigure>& figures);

/// Returns the accepted range of a check in words: "8 to 13 %", "at most 5 %", "at least 2".
std::string range_text(const figures::Check& check);

/// Returns a line for each check, claim and watched number that fails: "peak: expected 8 to 13 %, found 14 %".
std::vector<std::string> failures_of(const FigureResult& figure);

/// Returns a number as text for people, with `digits` significant digits: "10.82", "0.0002", "1.2e-09".
std::string short_number(double value, int digits = 4);

}  // namespace risorius::figures
