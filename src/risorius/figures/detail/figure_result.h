// SPDX-License-Identifier: MIT
/// \file
/// The result of an experiment: tables, charts, shapes to draw, and checks against published values. Nothing here writes files.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"
#include "risorius/plot/chart.h"

namespace risorius::figures {

/// A table of numbers.
struct Table {
    std::string name;                         ///< name of its CSV file
    std::vector<std::string> columns;         ///< with the unit: "time_s", "volume_change_percent"
    std::vector<std::vector<double>> rows;    ///< one number per column
    std::vector<std::string> row_names = {};  ///< empty, or a first column of names, one per row
};

/// A measured number and its accepted range.
struct Check {
    std::string name;  ///< "hang length at 3^3"
    std::string unit;
    double measured = 0;
    double low = 0, high = 0;  ///< the accepted range; its ends may be infinite
    /// The published value in words or numbers; empty when nothing was published
    std::string published;
    std::string note;  ///< why the measured value differs from the published one, or what it means
    /// Where the range comes from: "published", "law" (a law or closed form), "demand" (a requirement on the computation), "own"
    /// (around the value first measured here); empty when the file does not say.
    std::string range_from = "";
    bool differs = false;  ///< differs from the published value, although it is within the range

    bool passes() const { return measured >= low && measured <= high; }
};

/// A deformed object, to be drawn as in the thesis (see registry.h): a transparent surface, with the lines of its grid as wires.
struct Shape {
    std::string name;  ///< name of its picture
    std::string caption;
    Points positions;                       ///< V x 3, m, z up
    Triangles surface;                      ///< F x 3
    std::vector<std::array<int, 2>> wires;  ///< pairs of vertices
    std::vector<int> fixed;                 ///< vertices drawn as balls
    /// Empty, or one colour value 0..1 per vertex (softness, strain)
    std::vector<double> shade = {};
    /// Labels of the shades 0 and 1, such as "softest" and "stiffest"
    std::array<std::string, 2> shade_ends = {};
    Points outline = {};  ///< 2S x 3, m: ends of lines that show the rest shape
    std::string outline_name = "outline at rest";
};

/// All results of one experiment.
struct FigureResult {
    std::string id;  ///< "9b"
    std::string title;
    std::vector<Table> tables;
    std::vector<plot::Chart> charts;
    std::vector<Shape> shapes;
    std::vector<Check> checks;
    Json record = Json::object();  ///< parameters, steps and costs of the runs that were made

    bool passes() const {
        for (const Check& check : checks)
            if (!check.passes()) return false;
        return true;
    }
};

}  // namespace risorius::figures
