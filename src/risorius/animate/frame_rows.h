// SPDX-License-Identifier: MIT
/// \file
/// Reads a table of frames (frame_table.h) back into rows of cells with column names.
#pragma once

#include <string>
#include <vector>

namespace risorius::animate {

struct FrameRows {
    std::vector<std::string> names;
    /// The cells of each row as text, one per column
    std::vector<std::vector<std::string>> cells;

    int rows() const { return static_cast<int>(cells.size()); }
    int column(const std::string& name) const;  ///< -1 when there is no such column
    double number(int row, int column) const;
};

/// Parses a table. `table`: the text of FrameTable::text().
FrameRows frame_rows(const std::string& table);

/// Returns, for each frame, the largest displacement of a landmark since the first frame, m. All are 0 for a table without
/// landmarks.
std::vector<double> max_landmark_displacements(const FrameRows& rows);

/// Onset: the first frame in which a landmark has moved by 0.3 mm, or by 5 % of its maximum if that is less. Apex: the first frame
/// with 99 % of the maximum.
struct Moments {
    int onset = 0, apex = 0;
};
Moments moments_of(const std::vector<double>& displacements_m);

}  // namespace risorius::animate
