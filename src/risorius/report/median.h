// SPDX-License-Identifier: MIT
/// \file
/// The median of numbers.
#pragma once

#include <algorithm>
#include <vector>

namespace risorius::report {

/// Returns the median; 0 when there are no values.
inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace risorius::report
