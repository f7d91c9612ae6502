// SPDX-License-Identifier: MIT
#include "risorius/design/detail/crossing.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/design/conditions.h"
#include "risorius/design/design.h"

namespace risorius::design {

namespace {

constexpr int kMaxModulo = 1000;
constexpr std::size_t kMaxStrength = 4;

/// The number of conditions in the complete crossing of a set. Throws Error when there are too many.
long crossing(const ConditionSet& set) {
    long count = static_cast<long>(set.rows.size());
    for (const Factor& factor : set.factors) {
        count *= static_cast<long>(factor.levels.size());
        if (count > kMaxConditions)
            throw Error(set.place + "/factors",
                        std::to_string(kMaxConditions) + " conditions at most", "more");
    }
    return count;
}

bool keeps(const ConditionSet& set, const Relation& relation, const std::vector<int>& levels) {
    long sum = 0;
    for (const auto& [name, coefficient] : relation.sum)
        for (std::size_t f = 0; f < set.factors.size(); ++f)
            if (set.factors[f].name == name) sum += static_cast<long>(coefficient) * levels[f + 1];
    return ((sum - relation.remainder) % relation.modulo + relation.modulo) % relation.modulo == 0;
}

/// Frequencies of the rarest and of the most frequent combination of levels of some factors.
struct Counts {
    long min = 0, max = 0;
};

Counts counts_of(const std::vector<std::vector<int>>& conditions, const std::vector<long>& sizes,
                 const std::vector<std::size_t>& factors) {
    const auto wanted = static_cast<long>(conditions.size());
    long combinations = 1;
    for (const std::size_t f : factors) combinations *= sizes[f];
    if (combinations > wanted && factors.size() > 2) return {0, wanted};  // balance is impossible
    std::vector<long> count(static_cast<std::size_t>(combinations));
    for (const std::vector<int>& levels : conditions) {
        long at = 0;
        for (const std::size_t f : factors) at = at * sizes[f] + levels[f];
        ++count[static_cast<std::size_t>(at)];
    }
    const auto [min, max] = std::minmax_element(count.begin(), count.end());
    return {*min, *max};
}

/// Calls use(choice) for every choice of `size` out of `count` items until it returns false.
template <typename Use>
bool for_choices(std::size_t count, std::size_t size, const Use& use) {
    std::vector<std::size_t> choice(size);
    for (std::size_t i = 0; i < size; ++i) choice[i] = i;
    for (;;) {
        if (!use(choice)) return false;
        std::size_t i = size;
        while (i > 0 && choice[i - 1] == count - size + i - 1) --i;
        if (i == 0) return true;
        ++choice[i - 1];
        for (std::size_t k = i; k < size; ++k) choice[k] = choice[k - 1] + 1;
    }
}

}  // namespace

std::vector<Relation> read_fraction(const JsonCursor& json,
                                    const std::vector<std::string>& factors) {
    std::vector<Relation> out;
    for (const JsonCursor& one : json.items()) {
        one.allow_keys({"sum", "modulo", "remainder"});
        Relation relation;
        const JsonCursor sum = one.at("sum");
        std::set<std::string> names;
        const auto add = [&](const JsonCursor& place, const std::string& name, int coefficient) {
            index_of_name(place.place(), name, factors);
            if (!names.insert(name).second)
                place.fail("every factor once", risorius::in_quotes(name) + " again");
            relation.sum.emplace_back(name, coefficient);
        };
        if (sum.is_array())
            for (const JsonCursor& name : sum.items()) add(name, name.string(), 1);
        else
            for (const std::string& name : sum.keys())
                add(sum.at(name), name, sum.at(name).integer(1, kMaxModulo));
        if (relation.sum.size() < 2) sum.fail("at least two factors");
        relation.modulo = one.at("modulo").integer(2, kMaxModulo);
        if (const auto v = one.find("remainder"))
            relation.remainder = v->integer(0, relation.modulo - 1);
        out.push_back(std::move(relation));
    }
    if (out.empty()) json.fail("at least one relation", "none");
    return out;
}

std::vector<int> levels_of(const ConditionSet& set, long condition) {
    std::vector<int> out(set.factors.size() + 1);
    for (std::size_t f = set.factors.size(); f > 0; --f) {
        const auto count = static_cast<long>(set.factors[f - 1].levels.size());
        out[f] = static_cast<int>(condition % count);
        condition /= count;
    }
    out[0] = static_cast<int>(condition);
    return out;
}

std::vector<long> wanted_conditions(const ConditionSet& set, int seed) {
    std::vector<long> out;
    const long all = crossing(set);
    for (long i = 0; i < all; ++i) {
        const std::vector<int> levels = levels_of(set, i);
        if (std::all_of(set.fraction.begin(), set.fraction.end(),
                        [&](const Relation& one) { return keeps(set, one, levels); }))
            out.push_back(i);
    }
    if (out.empty()) throw Error(set.place + "/fraction", "at least one condition", "none");
    if (!set.draw) return out;
    if (*set.draw > static_cast<int>(out.size()))
        throw Error(set.place + "/draw",
                    "no more than the " + std::to_string(out.size()) + " conditions there are",
                    std::to_string(*set.draw));
    std::mt19937 random(static_cast<unsigned>(seed));
    for (std::size_t i = out.size(); i > 1; --i) std::swap(out[i - 1], out[random() % i]);
    out.resize(static_cast<std::size_t>(*set.draw));
    std::sort(out.begin(), out.end());
    return out;
}

Balance balance_of(const ConditionSet& set, int seed) {
    Balance out;
    out.all = crossing(set);
    std::vector<std::vector<int>> conditions;
    for (const long index : wanted_conditions(set, seed))
        conditions.push_back(levels_of(set, index));
    out.used = static_cast<long>(conditions.size());

    // Numbers of levels of the factors; the rows of the table count as one factor.
    std::vector<long> sizes{static_cast<long>(set.rows.size())};
    for (const Factor& factor : set.factors)
        sizes.push_back(static_cast<long>(factor.levels.size()));
    std::vector<std::size_t> varying;
    for (std::size_t f = 0; f < sizes.size(); ++f)
        if (sizes[f] > 1) varying.push_back(f);
    const auto of = [&](std::vector<std::size_t> choice) {
        for (std::size_t& f : choice) f = varying[f];
        return choice;
    };
    for (const std::size_t f : varying) {
        const Counts counts = counts_of(conditions, sizes, {f});
        out.factors.push_back(
            {f == 0 ? "conditions" : set.factors[f - 1].name, counts.min, counts.max});
    }
    if (varying.size() > 1) {
        out.pair_min = out.used;
        for_choices(varying.size(), 2, [&](const std::vector<std::size_t>& choice) {
            const Counts counts = counts_of(conditions, sizes, of(choice));
            out.pair_min = std::min(out.pair_min, counts.min);
            out.pair_max = std::max(out.pair_max, counts.max);
            return true;
        });
    }
    for (std::size_t size = 1; size <= std::min(varying.size(), kMaxStrength); ++size) {
        const bool even =
            for_choices(varying.size(), size, [&](const std::vector<std::size_t>& choice) {
                const Counts counts = counts_of(conditions, sizes, of(choice));
                return counts.min == counts.max;
            });
        if (!even) break;
        out.strength = static_cast<int>(size);
    }
    return out;
}

std::string Balance::text() const {
    const auto times = [](long min, long max) {
        return min == max ? std::to_string(min)
                          : std::to_string(min) + " to " + std::to_string(max);
    };
    std::string out = std::to_string(used) + " of " + std::to_string(all) + " conditions";
    for (const LevelCount& one : factors)
        out += (&one == &factors.front() ? "; every level of " : ", of ") + one.name + " " +
               times(one.min, one.max) + " times";
    if (pair_max > 0) out += "; two levels meet " + times(pair_min, pair_max) + " times";
    out += "; orthogonal array of strength " + std::to_string(strength);
    return out;
}

}  // namespace risorius::design
