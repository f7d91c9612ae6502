// A table of frames taken apart again: rows of numbers under names.
#pragma once

#include <string>
#include <vector>

namespace risorius::animate {

struct FrameRows {
    std::vector<std::string> names;
    std::vector<std::vector<std::string>>
        cells;  ///< as written, rows of as many as there are names

    int rows() const { return static_cast<int>(cells.size()); }
    int column(const std::string& name) const;  ///< -1: none
    double number(int row, int column) const;
};

/// What FrameTable::text() wrote.
FrameRows frame_rows(const std::string& table);

/// Of every frame, m: how far the landmark that moved farthest is from where it was in the first. Zeros without landmarks.
std::vector<double> landmark_ways(const FrameRows& rows);

/// First frame in which a landmark has moved by 0.3 mm, or 5 % of the farthest way; first in which one has gone 99 % of it.
struct Moments {
    int onset = 0, apex = 0;
};
Moments moments_of(const std::vector<double>& ways_m);

}  // namespace risorius::animate
