// SPDX-License-Identifier: MIT
/// \file
/// The result of an experiment as files: numbers as JSON and CSV, charts as SVG and PNG, shapes as pictures.
///
/// The same result gives the same bytes; nothing here knows the time.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "risorius/figures/detail/figure_result.h"
#include "risorius/plot/write_chart.h"

namespace risorius::figures {

/// A CSV file: comma separated, names in quotes where they need them, numbers with all their digits.
std::string csv_of(const figures::Table& table);

struct FigurePicture {
    std::string file;
    std::vector<std::string> captions;  ///< one per object, from left to right
    // For the legend
    bool held = false;                                 ///< some object
    std::string outline_name = "";                     ///< of the first object that has one
    std::array<std::string, 2> shade_ends = {"", ""};  ///< of the first object that has them
};

struct FigureFiles {
    std::vector<std::string> tables,
        charts;  ///< "volume.csv"; "volume" of volume.svg, .png, .gp, .data.csv
    std::vector<FigurePicture> pictures;
    std::vector<std::string> all;  ///< every file, in order of name
};

/// Writes all but results.json into `folder`, which must exist. Shapes that follow each other under one name stand side
/// by side in one picture. Throws Error for names that no file can have or that two results share, RunError when
/// something cannot be written or drawn.
FigureFiles write_figure(const figures::FigureResult& figure, const std::filesystem::path& folder,
                         const plot::ChartWriter& charts = {});

/// What results.json says of one figure, but for the list of its files.
Json figure_json(const figures::FigureResult& figure);

}  // namespace risorius::figures
