// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/curve_table.h"

#include <cassert>

namespace risorius::muscle {

CurveTable::CurveTable(const Curve& curve, double low, double high, int cells)
    : curve_(curve),
      low_(low),
      width_((high - low) / cells),
      cells_per_unit_(cells / (high - low)) {
    assert(high > low && cells > 0);
    Curve::Value at_begin = curve_.at(low);
    for (int i = 0; i < cells; ++i) {
        // Differences of the integral are taken from the value at the start of the cell, to keep their digits.
        const Curve::Value at_end = curve_.at(low + (i + 1) * width_);
        const double mean = (at_end.integral - at_begin.integral) / width_;
        cells_.push_back(
            solve::Lanes{at_begin.integral, at_begin.value,
                         (3 * mean - 2 * at_begin.value - at_end.value) / width_,
                         (at_begin.value + at_end.value - 2 * mean) / (width_ * width_)});
        at_begin = at_end;
    }
}

CurveTable::Value CurveTable::beyond(double x) const {
    const Curve::Value value = curve_.at(x);
    return {value.value, value.integral};
}

CurveTable::Values CurveTable::one_by_one(const solve::Lanes& x) const {
    Values out{};
    for (int k = 0; k < 4; ++k) {
        const Value one = at(x[k]);
        out.value[k] = one.value;
        out.integral[k] = one.integral;
    }
    return out;
}

}  // namespace risorius::muscle
