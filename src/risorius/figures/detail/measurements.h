// SPDX-License-Identifier: MIT
/// \file
/// Named measurements of an experiment, and their checks. The accepted ranges and published values are data of the experiment
/// file.
///
///   "checks": [{"measured": "peak_volume_change_percent/3x3x3", "low": 8, "high": 13, "range": "published",
///               "published": "up to ~10 %", "differs": true, "note": "..."}]
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/figures/detail/figure_result.h"

namespace risorius::figures {

class Measurements {
  public:
    /// Adds a measurement. `name` is a quantity that ends in its unit, followed by what was varied: "hang_length_ratio/3x3x3". A
    /// name may be added only once.
    void add(const std::string& name, const std::string& unit, double value);

    /// Reads the "checks" of the experiment file, if any. Throws Error for a name that was not measured; the message lists the
    /// measured ones.
    std::vector<Check> check(const JsonCursor& experiment) const;

    /// Returns a table with one row per measurement.
    Table table() const;

  private:
    struct Measurement {
        std::string name, unit;
        double value;
    };
    std::vector<Measurement> list_;
};

}  // namespace risorius::figures
