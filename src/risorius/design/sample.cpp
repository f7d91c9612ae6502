// SPDX-License-Identifier: MIT
#include "risorius/design/sample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "risorius/core/counter_rng.h"
#include "risorius/core/error.h"
#include "risorius/core/existing_file.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/design/table.h"

namespace risorius::design {

namespace {

constexpr int kMaxTrials = 100000, kMaxActive = 12, kMaxCandidates = 256;
constexpr int kKeysOfRise =
    12;  // intervals of a rise or fall, between which the script interpolates
constexpr double kBinomial = 0.6;              // Yu, Garrod and Schyns, as usually cited
constexpr double kWeightOfCount = 2;           // of the count of a unit beside those of its pairs
constexpr double kUnit = 1e4, kKeyUnit = 1e6;  // rounding of what is drawn, and of keys
constexpr int kMaxRefused = 10000;             // candidates with units that exclude each other

double rounded(double value) { return std::round(kUnit * value) / kUnit; }
double rounded_key(double value) { return std::round(kKeyUnit * value) / kKeyUnit; }

std::vector<std::string> face41() {
    std::vector<std::string> out;
    for (const int unit : {1,  2,  4,  5,  6,  7,  9,  10, 11, 12, 13, 14, 15, 16, 17,
                           18, 20, 22, 23, 24, 25, 26, 27, 28, 34, 35, 38, 39, 43})
        out.push_back("AU" + std::to_string(unit));
    for (const int unit : {2, 6, 10, 12, 14, 15})
        for (const char* side : {".l", ".r"}) out.push_back("AU" + std::to_string(unit) + side);
    return out;
}

double ramp(double u, double steepness) {
    const double up = std::pow(u, steepness);
    return up / (up + std::pow(1 - u, steepness));
}

Range read_range(const JsonCursor& json, const Range& allowed) {
    if (!json.is_array() || json.items().size() != 2) json.fail("[low, high]");
    const Range out{json.items()[0].number(allowed), json.items()[1].number(allowed)};
    if (out.max < out.min) json.items()[1].fail("the lower end or more", format_number(out.max));
    return out;
}

void read_times(const JsonCursor& json, SampleOptions& options) {
    json.allow_keys({"onset", "rise", "fall", "amplitude", "steepness"});
    const auto read = [&](const char* key, const Range& allowed, Range& range) {
        if (const auto v = json.find(key)) range = read_range(*v, allowed);
    };
    read("onset", {0, 60}, options.onset_s);
    read("rise", {0.01, 60}, options.rise_s);
    read("fall", {0.01, 60}, options.fall_s);
    read("amplitude", {0.01, 1}, options.amplitude);
    read("steepness", {1, 20}, options.steepness);
}

void read_units(const JsonCursor& json, SampleOptions& options) {
    if (json.is_string()) {
        json.one_of({"face41"});
        options.units = face41();
        return;
    }
    for (const JsonCursor& one : json.items()) {
        const std::string unit = one.string();
        if (!unit.starts_with("AU")) one.fail("an action unit, such as AU12", in_quotes(unit));
        if (std::count(options.units.begin(), options.units.end(), unit) > 0)
            one.fail("every unit once", in_quotes(unit) + " again");
        options.units.push_back(unit);
    }
    if (options.units.size() < 2) json.fail("two units or more");
}

/// Random numbers of a trial.
class Chance {
  public:
    Chance(unsigned seed, int trial) : seed_(seed), trial_(static_cast<std::uint64_t>(trial)) {}
    double next() { return CounterRng(seed_).at(trial_).at(drawn_++).uniform(); }
    double within(const Range& range) { return range.min + (range.max - range.min) * next(); }
    int below(int count) {
        return std::min(count - 1, static_cast<int>(next() * static_cast<double>(count)));
    }

  private:
    std::uint64_t seed_, trial_, drawn_ = 0;
};

int drawn_count(const SampleOptions& options, Chance& chance) {
    const int more = options.most_active - options.least_active;
    if (!options.binomial) return options.least_active + chance.below(more + 1);
    int count = options.least_active;
    for (int i = 0; i < more; ++i) count += chance.next() < kBinomial;
    return count;
}

UnitCourse drawn_course(const SampleOptions& options, const std::string& unit, Chance& chance) {
    const auto steepness = [&] {
        const Range logs{std::log(options.steepness.min), std::log(options.steepness.max)};
        return rounded(std::exp(chance.within(logs)));
    };
    UnitCourse course;
    course.unit = unit;
    course.amplitude = rounded(chance.within(options.amplitude));
    course.onset_latency_s = rounded(chance.within(options.onset_s));
    course.peak_latency_s = rounded(course.onset_latency_s + chance.within(options.rise_s));
    course.offset_latency_s =
        rounded(std::min(course.peak_latency_s + chance.within(options.fall_s), options.length_s));
    course.acceleration = steepness();
    course.deceleration = steepness();
    return course;
}

/// Draws sets of units that occur together as rarely as possible.
class BalancedSets {
  public:
    explicit BalancedSets(const SampleOptions& options)
        : options_(options),
          count_(static_cast<int>(options.units.size())),
          pairs_(static_cast<std::size_t>(count_ * count_)) {
        for (const auto& [a, b] : options.exclusive) {
            const auto at = [&](const std::string& unit) {
                return static_cast<int>(
                    std::find(options.units.begin(), options.units.end(), unit) -
                    options.units.begin());
            };
            excluded_.insert(std::minmax(at(a), at(b)));
        }
    }

    std::vector<int> next(int active, Chance& chance) {
        std::vector<int> best;
        double best_score = 0;
        for (int c = 0, refused = 0; c < options_.candidates;) {
            const std::vector<int> candidate = drawn(active, chance);
            if (is_excluded(candidate)) {
                if (++refused > kMaxRefused)
                    throw Error("sample/exclusive",
                                "units of which " + std::to_string(active) + " go together",
                                "too many that exclude each other");
                continue;
            }
            ++c;
            const double score = score_of(candidate);
            if (best.empty() || score < best_score) {
                best = candidate;
                best_score = score;
            }
        }
        for (const int a : best) {
            ++pair(a, a);
            for (const int b : best)
                if (a != b) ++pair(a, b);
        }
        sum_ += active;
        return best;
    }

  private:
    int& pair(int a, int b) { return pairs_[static_cast<std::size_t>(a * count_ + b)]; }

    std::vector<int> drawn(int active, Chance& chance) const {
        std::vector<int> units(static_cast<std::size_t>(count_));
        std::iota(units.begin(), units.end(), 0);
        for (int i = 0; i < active; ++i)
            std::swap(units[static_cast<std::size_t>(i)],
                      units[static_cast<std::size_t>(i + chance.below(count_ - i))]);
        units.resize(static_cast<std::size_t>(active));
        std::sort(units.begin(), units.end());
        return units;
    }
    bool is_excluded(const std::vector<int>& units) const {
        return std::any_of(excluded_.begin(), excluded_.end(), [&](const auto& both) {
            return std::binary_search(units.begin(), units.end(), both.first) &&
                   std::binary_search(units.begin(), units.end(), both.second);
        });
    }
    double score_of(const std::vector<int>& units) {
        double score = 0;
        for (const int a : units) {
            score += kWeightOfCount * (pair(a, a) - sum_ / count_);
            for (const int b : units)
                if (b > a) score += pair(a, b);
        }
        return score;
    }

    const SampleOptions& options_;
    int count_;
    std::vector<int>
        pairs_;  ///< in how many trials two units occur together; on the diagonal, a unit
    std::set<std::pair<int, int>> excluded_;
    double sum_ = 0;
};

/// The time at which a script has keys for a course.
std::vector<double> key_times(const UnitCourse& course) {
    std::vector<double> out;
    const auto add = [&](double from, double to) {
        for (int i = 0; i <= kKeysOfRise; ++i)
            out.push_back(rounded_key(from + (to - from) * i / kKeysOfRise));
    };
    add(course.onset_latency_s, course.peak_latency_s);
    add(course.peak_latency_s, course.offset_latency_s);
    return out;
}

}  // namespace

double UnitCourse::at(double t_s) const {
    if (t_s <= onset_latency_s || t_s >= offset_latency_s) return 0;
    if (t_s <= peak_latency_s)
        return amplitude *
               ramp((t_s - onset_latency_s) / (peak_latency_s - onset_latency_s), acceleration);
    return amplitude *
           (1 - ramp((t_s - peak_latency_s) / (offset_latency_s - peak_latency_s), deceleration));
}

const std::vector<std::string>& course_parameters() {
    static const std::vector<std::string> kNames{"amplitude",      "onset_latency_s",
                                                 "peak_latency_s", "offset_latency_s",
                                                 "acceleration",   "deceleration"};
    return kNames;
}

double& parameter(UnitCourse& course, std::size_t index) {
    double* const all[] = {&course.amplitude,      &course.onset_latency_s,
                           &course.peak_latency_s, &course.offset_latency_s,
                           &course.acceleration,   &course.deceleration};
    return *all[index];
}

double parameter(const UnitCourse& course, std::size_t index) {
    UnitCourse copy = course;
    return parameter(copy, index);
}

SampleOptions read_sample(const JsonCursor& json) {
    SampleOptions options;
    if (const auto table = json.find("table")) {
        json.allow_keys({"table", "length_s"});
        options.table = existing_file(*table);
        if (const auto v = json.find("length_s")) options.length_s = v->number({0.05, 60});
        return options;
    }
    json.allow_keys(
        {"units", "active", "active_law", "trials", "length_s", "balance", "times", "exclusive"});
    read_units(json.at("units"), options);
    options.trials = json.at("trials").integer(1, kMaxTrials);
    if (const auto v = json.find("active")) {
        if (!v->is_array() || v->items().size() != 2) v->fail("[least, most]");
        options.least_active = v->items()[0].integer(1, kMaxActive);
        options.most_active = v->items()[1].integer(options.least_active, kMaxActive);
    }
    if (static_cast<int>(options.units.size()) < options.most_active)
        json.at("units").fail(std::to_string(options.most_active) + " units or more",
                              std::to_string(options.units.size()));
    if (const auto v = json.find("active_law"))
        options.binomial = v->one_of({"uniform", "binomial"}) == "binomial";
    if (const auto v = json.find("length_s")) options.length_s = v->number({0.05, 60});
    if (const auto v = json.find("balance")) options.candidates = v->integer(1, kMaxCandidates);
    if (const auto v = json.find("times")) read_times(*v, options);
    if (options.onset_s.max + options.rise_s.max >= options.length_s)
        json.fail("a length_s of more than the latest peak, " +
                      format_number(options.onset_s.max + options.rise_s.max) + " s",
                  format_number(options.length_s));
    if (const auto v = json.find("exclusive"))
        for (const JsonCursor& both : v->items()) {
            if (!both.is_array() || both.items().size() != 2) both.fail("two units");
            for (const JsonCursor& one : both.items())
                index_of_name(one.place(), one.string(), options.units);
            options.exclusive.emplace_back(both.items()[0].string(), both.items()[1].string());
            if (options.exclusive.back().first == options.exclusive.back().second)
                both.fail("two different units", in_quotes(options.exclusive.back().first));
        }
    return options;
}

std::vector<Trial> sampled_trials(const SampleOptions& options, unsigned seed) {
    if (options.table) return read_trials(*options.table);
    BalancedSets sets(options);
    std::vector<Trial> out;
    for (int number = 1; number <= options.trials; ++number) {
        Chance chance(seed, number);
        Trial& trial = out.emplace_back();
        trial.number = number;
        for (const int unit : sets.next(drawn_count(options, chance), chance))
            trial.units.push_back(
                drawn_course(options, options.units[static_cast<std::size_t>(unit)], chance));
    }
    return out;
}

std::vector<Trial> read_trials(const std::filesystem::path& table) {
    std::map<int, Trial> trials;
    for (const std::vector<Given>& row : read_table(table)) {
        if (row.empty()) continue;
        std::map<std::string, JsonCursor> cells;
        for (const Given& cell : row) cells.emplace(cell.name, cell.value);
        const std::string place = row_place(row);
        const auto cell = [&](const std::string& name) -> const JsonCursor& {
            const auto found = cells.find(name);
            if (found == cells.end()) throw Error(place, "a value in the column " + name, "none");
            return found->second;
        };
        const int number = cell("trial").integer(1, 2147483647);
        UnitCourse course;
        course.unit = cell("unit").string();
        for (std::size_t i = 0; i < course_parameters().size(); ++i)
            parameter(course, i) = cell(course_parameters()[i]).number({i == 0 ? 1e-6 : 0, 60});
        if (course.amplitude > 1) cell("amplitude").fail("1 at most");
        if (!(course.onset_latency_s < course.peak_latency_s))
            cell("peak_latency_s").fail("a time after the onset");
        if (!(course.peak_latency_s < course.offset_latency_s))
            cell("offset_latency_s").fail("a time after the peak");
        Trial& trial = trials[number];
        trial.number = number;
        const auto same =
            std::find_if(trial.units.begin(), trial.units.end(),
                         [&](const UnitCourse& one) { return one.unit == course.unit; });
        if (same == trial.units.end())
            trial.units.push_back(course);
        else if (!(*same == course))  // several heads show the same trial
            throw Error(place, "the same course of " + course.unit + " in all rows of the trial",
                        "another one");
    }
    std::vector<Trial> out;
    for (auto& [number, trial] : trials) out.push_back(std::move(trial));
    return out;
}

Json with_units(Json script, const std::vector<UnitCourse>& units, double length_s,
                const std::string& place) {
    if (script.contains("duration_s"))
        throw Error(place, "a script without duration_s beside \"sample\", which has length_s",
                    "one with it");
    script["duration_s"] = length_s;
    // A unit and its half together: on that side the larger one counts at each moment.
    std::map<std::string, std::vector<const UnitCourse*>> channels;
    for (const UnitCourse& course : units) channels[course.unit].push_back(&course);
    for (const UnitCourse& course : units) {
        const bool halved = channels.count(course.unit + ".l") + channels.count(course.unit + ".r");
        if (!halved) continue;
        channels.erase(course.unit);
        for (const char* side : {".l", ".r"}) channels[course.unit + side].push_back(&course);
    }
    for (const auto& [name, courses] : channels) {
        if (script.contains("channels") && script.at("channels").contains(name))
            throw Error(place, "no channel " + name + " in the script, which \"sample\" draws",
                        "one");
        std::set<double> times;
        for (const UnitCourse* course : courses)
            for (const double t : key_times(*course)) times.insert(t);
        Json keys = Json::array();
        for (const double t : times) {
            double value = 0;
            for (const UnitCourse* course : courses) value = std::max(value, course->at(t));
            keys.push_back({t, rounded_key(value)});
        }
        script["channels"][name] = json_object({{"keys", std::move(keys)}});
    }
    return script;
}

SampleBalance balance_of(const std::vector<Trial>& trials, const SampleOptions& options) {
    std::vector<std::string> units = options.units;
    for (const Trial& trial : trials)
        for (const UnitCourse& course : trial.units)
            if (std::find(units.begin(), units.end(), course.unit) == units.end())
                units.push_back(course.unit);
    const std::size_t n = units.size();
    std::vector<double> together(n * n);
    for (const Trial& trial : trials)
        for (const UnitCourse& a : trial.units)
            for (const UnitCourse& b : trial.units) {
                const auto at = [&](const UnitCourse& one) {
                    return static_cast<std::size_t>(
                        std::find(units.begin(), units.end(), one.unit) - units.begin());
                };
                ++together[at(a) * n + at(b)];
            }
    SampleBalance out{.trials = static_cast<int>(trials.size()), .units = static_cast<int>(n)};
    const auto all = static_cast<double>(trials.size());
    for (std::size_t a = 0; a < n; ++a) {
        const double count = together[a * n + a];
        out.least = a == 0 ? static_cast<int>(count) : std::min(out.least, static_cast<int>(count));
        out.most = std::max(out.most, static_cast<int>(count));
        for (std::size_t b = 0; b < a; ++b) {
            const auto excluded = [&](const auto& both) {
                return (both.first == units[a] && both.second == units[b]) ||
                       (both.first == units[b] && both.second == units[a]);
            };
            if (std::any_of(options.exclusive.begin(), options.exclusive.end(), excluded)) continue;
            const double p = count / all, q = together[b * n + b] / all;
            const double spread = std::sqrt(p * (1 - p) * q * (1 - q));
            if (spread > 0)
                out.largest_correlation = std::max(
                    out.largest_correlation, std::abs(together[a * n + b] / all - p * q) / spread);
        }
    }
    return out;
}

std::string SampleBalance::text() const {
    return std::to_string(trials) + " trials of " + std::to_string(units) +
           " units, each active in " + std::to_string(least) + " to " + std::to_string(most) +
           "; largest correlation of two units " +
           format_number(std::round(1000 * largest_correlation) / 1000);
}

}  // namespace risorius::design
