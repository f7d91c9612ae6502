// SPDX-License-Identifier: MIT
#include "risorius/animate/frame_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace risorius::animate {

namespace {

constexpr double kOnset_m = 0.3e-3, kOnsetFraction = 0.05;
// Less than 1 because a held face still moves by micrometres
constexpr double kApexFraction = 0.99;

std::vector<std::string> split(const std::string& text, char by) {
    std::vector<std::string> out;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find(by, begin)) != std::string::npos; begin = end + 1)
        out.push_back(text.substr(begin, end - begin));
    if (begin < text.size()) out.push_back(text.substr(begin));
    return out;
}

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

int FrameRows::column(const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

double FrameRows::number(int row, int column) const {
    return std::strtod(
        cells[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)].c_str(), nullptr);
}

FrameRows frame_rows(const std::string& table) {
    FrameRows out;
    const std::vector<std::string> lines = split(table, '\n');
    if (lines.empty()) return out;
    out.names = split(lines[0], '\t');
    for (std::size_t i = 1; i < lines.size(); ++i) {
        out.cells.push_back(split(lines[i], '\t'));
        out.cells.back().resize(out.names.size());
    }
    return out;
}

std::vector<double> max_landmark_displacements(const FrameRows& rows) {
    std::vector<double> out(rows.cells.size(), 0);
    for (std::size_t c = 0; c + 2 < rows.names.size(); ++c) {
        if (!ends_with(rows.names[c], ".x_mm")) continue;
        for (int r = 0; r < rows.rows(); ++r) {
            double squared = 0;
            for (int k = 0; k < 3; ++k) {
                const int column = static_cast<int>(c) + k;
                squared += std::pow(rows.number(r, column) - rows.number(0, column), 2);
            }
            double& displacement = out[static_cast<std::size_t>(r)];
            displacement = std::max(displacement, 1e-3 * std::sqrt(squared));
        }
    }
    return out;
}

Moments moments_of(const std::vector<double>& displacements_m) {
    Moments out;
    if (displacements_m.empty()) return out;
    const auto max = std::max_element(displacements_m.begin(), displacements_m.end());
    const double there = kApexFraction * *max;
    out.apex = static_cast<int>(std::find_if(displacements_m.begin(), displacements_m.end(),
                                             [&](double one) { return one >= there; }) -
                                displacements_m.begin());
    const double begun = std::min(kOnset_m, kOnsetFraction * *max);
    for (std::size_t i = 0; i < displacements_m.size() && begun > 0; ++i)
        if (displacements_m[i] > begun) {
            out.onset = static_cast<int>(i);
            break;
        }
    return out;
}

}  // namespace risorius::animate
