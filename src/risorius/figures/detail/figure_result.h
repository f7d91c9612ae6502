// SPDX-License-Identifier: MIT
/// \file
/// What an experiment leaves: tables, charts, shapes to be drawn and checks against what was published. It writes nothing.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/plot/chart.h"

namespace risorius::figures {

struct Table {
    std::string name;                         ///< of its CSV file
    std::vector<std::string> columns;         ///< with the unit: "time_s", "volume_change_percent"
    std::vector<std::vector<double>> rows;    ///< one number per column
    std::vector<std::string> row_names = {};  ///< empty, or a first column of names, one per row
};

/// A number against what it should be.
struct Check {
    std::string name;  ///< "hang length at 3^3"
    std::string unit;
    double measured = 0;
    double low = 0, high = 0;  ///< the accepted range; infinite ends allowed
    std::string
        published;     ///< what the thesis says, in words or numbers; empty when it says nothing
    std::string note;  ///< why it differs, or what it means
    /// Where the range comes from: "published", "law" (or closed form), "demand" (on the computation), "own" (around
    /// the value first measured here); empty when the file does not say.
    std::string range_from = "";
    bool differs = false;  ///< from what was published, though within the range

    bool passes() const { return measured >= low && measured <= high; }
};

/// A deformed object: the surface drawn transparent, its grid lines drawn as wires, as in the thesis.
struct Shape {
    std::string name;  ///< of its picture
    std::string caption;
    Points positions;                       ///< V x 3, m, z up
    Triangles surface;                      ///< F x 3
    std::vector<std::array<int, 2>> wires;  ///< pairs of vertices
    std::vector<int> fixed;                 ///< vertices drawn as balls
    std::vector<double> shade =
        {};  ///< empty, or one value 0..1 per vertex for colour (softness, strain)
    std::array<std::string, 2> shade_ends = {};  ///< what 0 and 1 mean: "softest", "stiffest"
    Points outline = {};  ///< 2S x 3, m: ends of lines that show where it was at rest
    std::string outline_name = "outline at rest";
};

struct FigureResult {
    std::string id;  ///< "9b"
    std::string title;
    std::vector<Table> tables;
    std::vector<plot::Chart> charts;
    std::vector<Shape> shapes;
    std::vector<Check> checks;
    Json record = Json::object();  ///< what was really run: parameters, steps, costs

    bool passes() const {
        for (const Check& check : checks)
            if (!check.passes()) return false;
        return true;
    }
};

}  // namespace risorius::figures
