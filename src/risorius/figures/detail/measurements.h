// SPDX-License-Identifier: MIT
/// \file
/// Named measurements of an experiment, their checks, and the verdicts on what was published. Ranges and published values are data
/// of the experiment file.
///
///   "checks": [{"measured": "sag_m/41", "low": 0.3626, "high": 0.3632, "range": "law", "note": "the catenary: 0.36278 m"}],
///   "claims": [{"says": "The step falls with the resolution.", "finds": "It grows by a half.", "verdict": "missed",
///               "measured": "step_s/11x11", "over": "step_s/7x7", "high": 0.9}],
///   "watched": [{"measured": "steps/11x11", "low": 90, "high": 110}]
///
/// With "over", a claim is about the ratio of two measurements.
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
    /// The same for "claims" and "watched".
    std::vector<Claim> claims(const JsonCursor& experiment) const;
    std::vector<Check> watched(const JsonCursor& experiment) const;

    /// Reads the three lists before anything is measured. Throws Error for what is wrong whatever the names of the measurements are.
    static void check_lists(const JsonCursor& experiment);

    /// Returns a table with one row per measurement.
    Table table() const;

  private:
    struct Measurement {
        std::string name, unit;
        double value;
    };
    const Measurement& named(const JsonCursor& name) const;
    Check read_check(const JsonCursor& json) const;
    std::vector<Measurement> list_;
    bool before_the_run_ = false;
};

}  // namespace risorius::figures
