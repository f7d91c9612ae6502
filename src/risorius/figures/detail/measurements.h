// SPDX-License-Identifier: MIT
/// \file
/// What an experiment measured, by name, and the checks its file makes of it: bands and published values are data.
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
    /// `name` ends in its unit, then what it was varied by: "hang_length_ratio/3x3x3". The same name twice is a mistake
    /// of the program.
    void add(const std::string& name, const std::string& unit, double value);

    /// Reads the "checks" of the experiment file (none when it has none). A name that was not measured is an Error that
    /// lists what was.
    std::vector<Check> check(const JsonCursor& experiment) const;

    /// One row per measurement.
    Table table() const;

  private:
    struct Measurement {
        std::string name, unit;
        double value;
    };
    std::vector<Measurement> list_;
};

}  // namespace risorius::figures
