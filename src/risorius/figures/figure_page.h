// SPDX-License-Identifier: MIT
/// \file
/// One HTML page with figures side by side: what was published, what was measured, pictures and charts, and why they differ.
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
    std::string folder;     ///< of its files from the page, "" or "9b/"
    std::string readme;     ///< Markdown; empty when there is none
    double run_time_s = 0;  ///< about, as the list of figures says; 0 when it says nothing
    figures::Origin origin = figures::Origin::kOwn;
    std::string
        published;  ///< file name of a picture of the published figure; empty when there is none
};

std::string figure_page(const std::vector<ShownFigure>& figures);

/// "8 to 13 %", "at most 5 %", "at least 2": the accepted range of a check in words.
std::string range_text(const figures::Check& check);

/// Four significant digits or as many as asked for, as people read them: "10.82", "0.0002", "1.2e-09".
std::string short_number(double value, int digits = 4);

}  // namespace risorius::figures
