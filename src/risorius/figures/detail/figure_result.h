// SPDX-License-Identifier: MIT
/// \file
/// The result of an experiment: tables, charts, shapes to draw, checks, and verdicts on what was published. Nothing here writes files.
#pragma once

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
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
    std::string published;     ///< the published value; empty unless the range is around one
    std::string note;          ///< what the value means
    /// Where the range comes from: "published", "law" (a law or closed form), "demand" (a requirement on the computation); empty when
    /// the file does not say, and for watched numbers.
    std::string range_from = "";

    bool passes() const { return measured >= low && measured <= high; }
};

/// What comes of a published claim.
enum class Verdict {
    kAgrees,
    kMissed,   ///< what is measured here contradicts it
    kUnknown,  ///< nothing can be measured against it: a size or a number was not published
};

/// A statement of a publication, what is found here, and the verdict. A band says what the claim means in numbers: the verdict is
/// "agrees" inside of it and "missed" outside, and any other verdict is a fault.
struct Claim {
    std::string says, finds;
    Verdict verdict = Verdict::kAgrees;
    bool measured = false;  ///< whether there is a band
    std::string name = {}, unit = {};
    double value = 0, low = 0, high = 0;

    bool inside() const { return value >= low && value <= high; }
    bool holds() const { return !measured || inside() == (verdict == Verdict::kAgrees); }
};

std::string_view name_of(Verdict verdict);  ///< "agrees", "missed", "cannot be known"

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
    std::vector<Claim> claims = {};
    /// Numbers with a range around the value first measured here, so that a change is noticed. They prove nothing and are not checks.
    std::vector<Check> watched = {};
    Json record = Json::object();  ///< parameters, steps and costs of the runs that were made

    bool passes() const {
        const auto passes = [](const Check& check) { return check.passes(); };
        return std::all_of(checks.begin(), checks.end(), passes) &&
               std::all_of(watched.begin(), watched.end(), passes) &&
               std::all_of(claims.begin(), claims.end(),
                           [](const Claim& claim) { return claim.holds(); });
    }
};

}  // namespace risorius::figures
