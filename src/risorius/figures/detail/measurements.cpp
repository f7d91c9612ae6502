// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/measurements.h"

#include <algorithm>
#include <cassert>
#include <string_view>

namespace risorius::figures {

void Measurements::add(const std::string& name, const std::string& unit, double value) {
    assert(std::none_of(list_.begin(), list_.end(),
                        [&](const Measurement& known) { return known.name == name; }));
    list_.push_back({name, unit, value});
}

std::vector<Check> Measurements::check(const JsonCursor& experiment) const {
    std::vector<Check> checks;
    const auto listed = experiment.find("checks");
    if (!listed) return checks;

    std::vector<std::string_view> names;
    for (const Measurement& m : list_) names.push_back(m.name);
    for (const JsonCursor& json : listed->items()) {
        json.allow_keys(
            {"measured", "name", "low", "high", "range", "published", "differs", "note"});
        const std::string name = json.at("measured").one_of(names);
        const Measurement* found = nullptr;
        for (const Measurement& m : list_)
            if (m.name == name) found = &m;

        Check check;
        check.name = json.has("name") ? json.at("name").string() : name;
        check.unit = found->unit;
        check.measured = found->value;
        check.low = json.has("low") ? json.at("low").number() : -kInfinity;
        check.high = json.has("high") ? json.at("high").number() : kInfinity;
        if (check.low > check.high)
            json.at("low").fail("at most \"high\", which is " + format_number(check.high));
        if (json.has("published")) check.published = json.at("published").string();
        if (json.has("differs")) check.differs = json.at("differs").boolean();
        if (check.differs && check.published.empty())
            json.at("differs").fail("false where nothing is \"published\"", "true");
        if (json.has("range"))
            check.range_from = json.at("range").one_of({"published", "law", "demand", "own"});
        if (json.has("note")) check.note = json.at("note").string();
        checks.push_back(std::move(check));
    }
    return checks;
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
