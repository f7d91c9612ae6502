// SPDX-License-Identifier: MIT
/// \file
/// Random facial movements for reverse correlation. Each trial has some action units, drawn at random, and each of them a course of
/// its own:
///
///   a(t) = A h_p((t - t0) / (tp - t0))          from the onset t0 to the peak tp
///   a(t) = A (1 - h_q((t - tp) / (t1 - tp)))    from the peak to the offset t1
///   h_p(u) = u^p / (u^p + (1 - u)^p)            p is the acceleration, q the deceleration
///
/// so that the largest speed is A p / (tp - t0) on the way up. The units are drawn such that any two are as independent as possible:
/// of several candidates for a trial, the one is taken whose pairs and units have occurred least. A trial depends on the seed and on
/// the trials before it, so that a longer sample begins as a shorter one.
///
/// Source of the method: Yu, Garrod, Schyns 2012, Computers & Graphics 36(3), 152-162 (Generative Face Grammar).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::design {

/// How an action unit moves in a trial.
struct UnitCourse {
    std::string unit;  ///< as in scripts: "AU12", "AU12.l"
    double amplitude = 1;
    double onset_latency_s = 0, peak_latency_s = 0, offset_latency_s = 0;
    double acceleration = 1, deceleration = 1;

    double at(double t_s) const;
    friend bool operator==(const UnitCourse&, const UnitCourse&) = default;
};

/// The names of the numbers of a UnitCourse, as in tables.
const std::vector<std::string>& course_parameters();
/// The number with that name.
double& parameter(UnitCourse& course, std::size_t index);
double parameter(const UnitCourse& course, std::size_t index);

/// What is drawn.
struct SampleOptions {
    std::vector<std::string> units;
    int least_active = 1, most_active = 6;
    bool binomial = false;  ///< whether the number of units is least + Binomial(most - least, 0.6)
    int trials = 0;
    double length_s = 1.25;
    int candidates = 16;                                         ///< per trial; 1: plain draws
    std::vector<std::pair<std::string, std::string>> exclusive;  ///< never together
    /// Ranges: onset, times up and down, amplitude, acceleration and deceleration
    Range onset_s{0, 0.5}, rise_s{0.15, 0.6}, fall_s{0.15, 0.6}, amplitude{0.3, 1},
        steepness{1.2, 4};
    /// The trials of a table instead of drawn ones
    std::optional<std::filesystem::path> table;
};

/// Reads the key "sample" of a set. Throws Error.
SampleOptions read_sample(const JsonCursor& json);

/// The trials of a sample, in their order, or by the table.
struct Trial {
    int number = 1;
    std::vector<UnitCourse> units;
};
std::vector<Trial> sampled_trials(const SampleOptions& options, unsigned seed);

/// Reads the trials of a table as the set has it, sample.tsv. Throws Error.
std::vector<Trial> read_trials(const std::filesystem::path& table);

/// Adds the units to a script, which gets its length by this. Throws Error when it has a channel of them already.
Json with_units(Json script, const std::vector<UnitCourse>& units, double length_s,
                const std::string& place);

/// How often units occur in a sample, and how independent they are.
struct SampleBalance {
    int trials = 0, units = 0, least = 0,
        most = 0;                    ///< trials of the rarest and of the most frequent unit
    double largest_correlation = 0;  ///< of two units that may occur together, in absolute value
    std::string text() const;
};
SampleBalance balance_of(const std::vector<Trial>& trials, const SampleOptions& options);

}  // namespace risorius::design
