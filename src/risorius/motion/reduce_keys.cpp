// SPDX-License-Identifier: MIT
#include "risorius/motion/reduce_keys.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace risorius::motion {

std::vector<track::Key> reduce_keys(const std::vector<double>& times_s,
                                    const std::vector<double>& values, double tolerance) {
    assert(times_s.size() == values.size());
    std::vector<track::Key> out;
    if (values.empty()) return out;
    out.push_back({times_s[0], values[0]});
    if (std::all_of(values.begin(), values.end(),
                    [&](double value) { return std::abs(value - values[0]) <= tolerance; }))
        return out;
    for (std::size_t from = 0; from + 1 < values.size();) {
        double least = -std::numeric_limits<double>::infinity(), most = -least;
        std::size_t last = from + 1;
        for (std::size_t to = from + 1; to < values.size() && least <= most; ++to) {
            const double run = times_s[to] - times_s[from], rise = values[to] - values[from];
            if (rise / run >= least && rise / run <= most) last = to;
            least = std::max(least, (rise - tolerance) / run);
            most = std::min(most, (rise + tolerance) / run);
        }
        out.push_back({times_s[last], values[last]});
        from = last;
    }
    return out;
}

}  // namespace risorius::motion
