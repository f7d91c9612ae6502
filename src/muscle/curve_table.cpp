#include "muscle/curve_table.h"

#include <cassert>

namespace risorius::muscle {

CurveTable::CurveTable(const Curve& curve, double low, double high, int cells)
    : curve_(curve), low_(low), cells_per_unit_(cells / (high - low)) {
    assert(high > low && cells > 0);
    const double width = (high - low) / cells;
    Curve::Value at_begin = curve_.at(low);
    for (int i = 0; i < cells; ++i) {
        // Differences of the integral are taken from the value at the begin, which keeps their digits
        const double begin = low + i * width;
        const Curve::Value at_end = curve_.at(low + (i + 1) * width);
        const double mean = (at_end.integral - at_begin.integral) / width;
        cells_.push_back({begin, at_begin.integral, at_begin.value,
                          (3 * mean - 2 * at_begin.value - at_end.value) / width,
                          (at_begin.value + at_end.value - 2 * mean) / (width * width)});
        at_begin = at_end;
    }
}

CurveTable::Value CurveTable::beyond(double x) const {
    const Curve::Value value = curve_.at(x);
    return {value.value, value.integral};
}

}  // namespace risorius::muscle
