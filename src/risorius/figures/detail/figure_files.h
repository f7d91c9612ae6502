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

/// Returns a table as CSV: values are separated by commas, names are quoted where needed, and numbers have all their digits.
std::string csv_of(const figures::Table& table);

/// A picture file, and what its legend needs.
struct FigurePicture {
    std::string file;
    std::vector<std::string> captions;  ///< one per object, from left to right
    // For the legend
    bool held = false;  ///< whether an object has fixed vertices
    /// Shape::outline_name of the first object with an outline
    std::string outline_name = "";
    /// Shape::shade_ends of the first object with shades
    std::array<std::string, 2> shade_ends = {"", ""};
};

/// Names of the files of one figure.
struct FigureFiles {
    /// Names of tables and of charts. A table has the name of its file, such as "volume.csv". A chart has a name without ending,
    /// such as "volume", for its files volume.svg, .png, .gp and .data.csv
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
