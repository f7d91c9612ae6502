// SPDX-License-Identifier: MIT
/// \file
/// A curve as a table for inner loops. Its integral is stored as cubics on equal cells and its value is their slope, so that
/// energy and force agree up to rounding for any width of the cells.
///
/// At the ends of cells, value and integral are those of the curve. Between them the error of the value is at most |f'''| w^3 /
/// 124, where f''' is the third derivative of the curve and w is the width of a cell. Outside the range of the table the curve
/// itself is evaluated.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/muscle/detail/curve.h"
#include "risorius/solve/lanes.h"

namespace risorius::muscle {

/// The table of one curve.
class CurveTable {
  public:
    struct Value {
        double value, integral;
    };
    /// A table from `low` to `high` with `cells` equal cells. Kinks of the curve should be at ends of cells.
    CurveTable(const Curve& curve, double low, double high, int cells);

    Value at(double x) const {
        const double place = (x - low_) * cells_per_unit_;
        if (!(place >= 0 && place < static_cast<double>(cells_.size()))) return beyond(x);
        const auto cell = static_cast<std::size_t>(place);
        const solve::Lanes& c = cells_[cell];
        const double u = x - (low_ + static_cast<double>(cell) * width_);
        return {c[1] + u * (2 * c[2] + u * 3 * c[3]), c[0] + u * (c[1] + u * (c[2] + u * c[3]))};
    }

    struct Values {
        solve::Lanes value, integral;
    };
    /// The same for four numbers. The results are equal to the last bit.
    Values at(const solve::Lanes& x) const {
        const solve::Lanes place = (x - low_) * cells_per_unit_;
        const auto within = (place >= 0.0) & (place < static_cast<double>(cells_.size()));
        if (!(within[0] & within[1] & within[2] & within[3])) return one_by_one(x);
        typedef std::int32_t Cells __attribute__((vector_size(16)));
        const Cells cell = __builtin_convertvector(place, Cells);
        const solve::Lanes begin = __builtin_convertvector(cell, solve::Lanes);
        const solve::Lanes row[4] = {
            cells_[static_cast<std::size_t>(cell[0])], cells_[static_cast<std::size_t>(cell[1])],
            cells_[static_cast<std::size_t>(cell[2])], cells_[static_cast<std::size_t>(cell[3])]};
        const solve::Lanes u = x - (low_ + begin * width_);
        solve::Lanes c0, c1, c2, c3;
        solve::transpose(row, c0, c1, c2, c3);
        return {c1 + u * (2 * c2 + u * 3 * c3), c0 + u * (c1 + u * (c2 + u * c3))};
    }

  private:
    Value beyond(double x) const;
    Values one_by_one(const solve::Lanes& x) const;

    Curve curve_;
    double low_, width_, cells_per_unit_;
    /// c0 .. c3 of each cell: the integral is c0 + c1 u + c2 u^2 + c3 u^3, with u = x - start of the cell.
    std::vector<solve::Lanes> cells_;
};

}  // namespace risorius::muscle
