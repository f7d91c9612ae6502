// A curve as a table for inner loops: its integral as cubics on equal cells, its value as their slope, so that energy and
// force agree to rounding whatever the width of the cells.
//
// At the ends of cells value and integral are those of the curve; between them the value is off by less than
// f''' w^2 / 70, w the width of a cell. Beyond the table the curve itself is asked.
#pragma once

#include <vector>

#include "muscle/curve.h"

namespace risorius::muscle {

class CurveTable {
  public:
    struct Value {
        double value, integral;
    };
    /// From `low` to `high` in `cells` equal cells. Ends of cells should lie where the curve has kinks.
    CurveTable(const Curve& curve, double low, double high, int cells);

    Value at(double x) const {
        const double place = (x - low_) * cells_per_unit_;
        if (!(place >= 0 && place < static_cast<double>(cells_.size()))) return beyond(x);
        const Cell& cell = cells_[static_cast<std::size_t>(place)];
        const double u = x - cell.begin;
        return {cell.c1 + u * (2 * cell.c2 + u * 3 * cell.c3),
                cell.c0 + u * (cell.c1 + u * (cell.c2 + u * cell.c3))};
    }

  private:
    struct Cell {
        double begin, c0, c1, c2, c3;
    };
    Value beyond(double x) const;

    Curve curve_;
    double low_, cells_per_unit_;
    std::vector<Cell> cells_;
};

}  // namespace risorius::muscle
