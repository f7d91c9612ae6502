// The middle of some numbers, so that one slow moment does not count.
#pragma once

#include <algorithm>
#include <vector>

namespace risorius::report {

/// 0 of none.
inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace risorius::report
