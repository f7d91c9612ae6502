// SPDX-License-Identifier: MIT
/// \file
/// Writes the result of an experiment to files: numbers as JSON and CSV, charts as SVG and PNG, shapes as pictures.
///
/// The same result gives the same bytes; no file contains a time or date.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "risorius/figures/detail/figure_result.h"
#include "risorius/plot/write_chart.h"

namespace risorius::figures {

/// A table as CSV: comma separated, names quoted where needed, numbers with all digits.
std::string csv_of(const figures::Table& table);

/// A picture file, and what its legend needs.
struct FigurePicture {
    std::string file;
    std::vector<std::string> captions;  ///< one per object, from left to right
    // For the legend
    bool held = false;                                 ///< whether an object has fixed vertices
    std::string outline_name = "";                     ///< that of the first object with an outline
    std::array<std::string, 2> shade_ends = {"", ""};  ///< those of the first object with shades
};

/// Names of the files of one figure.
struct FigureFiles {
    /// Tables by file name, such as "volume.csv"; charts by name, such as "volume" for volume.svg, .png, .gp and .data.csv
    std::vector<std::string> tables, charts;
    std::vector<FigurePicture> pictures;
    std::vector<std::string> all;  ///< every file, sorted by name
};

/// Writes all files except results.json into `folder`, which must exist. Consecutive shapes with the same name stand side by side
/// in one picture. Throws Error for names that no file can have and for two results with the same name, and RunError when
/// something cannot be written or drawn.
FigureFiles write_figure(const figures::FigureResult& figure, const std::filesystem::path& folder,
                         const plot::ChartWriter& charts = {});

/// The content of results.json for one figure, without the list of its files.
Json figure_json(const figures::FigureResult& figure);

}  // namespace risorius::figures
