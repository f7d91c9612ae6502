// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/measurements.h"

#include <algorithm>
#include <cassert>
#include <string_view>

namespace risorius::figures {

std::string_view name_of(Verdict verdict) {
    return verdict == Verdict::kAgrees   ? "agrees"
           : verdict == Verdict::kMissed ? "missed"
                                         : "cannot be known";
}

namespace {

/// Reads "low" and "high"; an end that is not given is infinite.
void read_band(const JsonCursor& json, double& low, double& high) {
    low = json.has("low") ? json.at("low").number() : -kInfinity;
    high = json.has("high") ? json.at("high").number() : kInfinity;
    if (low > high) json.at("low").fail("at most \"high\", which is " + format_number(high));
}

}  // namespace

void Measurements::add(const std::string& name, const std::string& unit, double value) {
    assert(std::none_of(list_.begin(), list_.end(),
                        [&](const Measurement& known) { return known.name == name; }));
    list_.push_back({name, unit, value});
}

const Measurements::Measurement& Measurements::named(const JsonCursor& name) const {
    if (before_the_run_) {
        static const Measurement any{"any", "", 1};
        name.string();
        return any;
    }
    std::vector<std::string_view> names;
    for (const Measurement& m : list_) names.push_back(m.name);
    const std::string found = name.one_of(names);
    return *std::find_if(list_.begin(), list_.end(),
                         [&](const Measurement& m) { return m.name == found; });
}

Check Measurements::read_check(const JsonCursor& json) const {
    const Measurement& found = named(json.at("measured"));
    Check check;
    check.name = json.has("name") ? json.at("name").string() : found.name;
    check.unit = found.unit;
    check.measured = found.value;
    read_band(json, check.low, check.high);
    if (json.has("note")) check.note = json.at("note").string();
    return check;
}

std::vector<Check> Measurements::check(const JsonCursor& experiment) const {
    std::vector<Check> checks;
    const auto listed = experiment.find("checks");
    if (!listed) return checks;
    for (const JsonCursor& json : listed->items()) {
        json.allow_keys({"measured", "name", "low", "high", "range", "published", "note"});
        Check check = read_check(json);
        if (json.has("range"))
            check.range_from = json.at("range").one_of({"published", "law", "demand"});
        if (json.has("published")) {
            check.published = json.at("published").string();
            if (check.range_from != "published")
                json.at("published")
                    .fail("nothing unless \"range\" is \"published\"",
                          "\"" + check.published + "\"");
        }
        checks.push_back(std::move(check));
    }
    return checks;
}

std::vector<Check> Measurements::watched(const JsonCursor& experiment) const {
    std::vector<Check> watched;
    const auto listed = experiment.find("watched");
    if (!listed) return watched;
    for (const JsonCursor& json : listed->items()) {
        json.allow_keys({"measured", "name", "low", "high", "note"});
        watched.push_back(read_check(json));
    }
    return watched;
}

std::vector<Claim> Measurements::claims(const JsonCursor& experiment) const {
    std::vector<Claim> claims;
    const auto listed = experiment.find("claims");
    if (!listed) return claims;
    for (const JsonCursor& json : listed->items()) {
        json.allow_keys({"says", "finds", "verdict", "measured", "over", "low", "high"});
        Claim claim{.says = json.at("says").string(), .finds = json.at("finds").string()};
        const std::string verdict = json.at("verdict").one_of(
            {name_of(Verdict::kAgrees), name_of(Verdict::kMissed), name_of(Verdict::kUnknown)});
        for (const Verdict one : {Verdict::kAgrees, Verdict::kMissed, Verdict::kUnknown})
            if (verdict == name_of(one)) claim.verdict = one;
        claim.measured = json.has("measured");
        if (claim.measured) {
            if (claim.verdict == Verdict::kUnknown)
                json.at("measured").fail("nothing where the verdict is \"cannot be known\"");
            if (!json.has("low") && !json.has("high"))
                json.at("measured").fail("a measurement with \"low\" or \"high\"");
            const Measurement& found = named(json.at("measured"));
            claim.name = found.name;
            claim.unit = found.unit;
            claim.value = found.value;
            read_band(json, claim.low, claim.high);
            if (json.has("over")) {
                const Measurement& below = named(json.at("over"));
                claim.name += " over " + below.name;
                claim.unit = found.unit == below.unit ? "" : found.unit + " / " + below.unit;
                claim.value /= below.value;
            }
        } else {
            for (const char* key : {"over", "low", "high"})
                if (json.has(key)) json.at(key).fail("\"measured\" beside it");
        }
        claims.push_back(std::move(claim));
    }
    return claims;
}

void Measurements::check_lists(const JsonCursor& experiment) {
    Measurements any;
    any.before_the_run_ = true;
    any.check(experiment);
    any.claims(experiment);
    any.watched(experiment);
}

Table Measurements::table() const {
    Table table{.name = "measurements", .columns = {"value"}, .rows = {}, .row_names = {}};
    for (const Measurement& m : list_) {
        table.row_names.push_back(m.unit.empty() ? m.name : m.name + " [" + m.unit + "]");
        table.rows.push_back({m.value});
    }
    return table;
}

}  // namespace risorius::figures
