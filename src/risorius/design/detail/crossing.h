// Which conditions of a crossing are wanted: all, a regular fraction, or some by chance; and how even the choice is.
//
// Levels are numbered from 0 in the order of the file. A relation keeps the conditions in which
//
//     sum of coefficient * number of the level  =  remainder   (modulo m)
//
// With m the number of levels, a prime, k independent relations keep 1/m^k of the crossing, and every choice of t factors is
// met equally often in each combination when each sum (and each combination of sums) has more than t factors in it: a regular
// fractional factorial of resolution t + 1, an orthogonal array of strength t. Sums of two factors of m levels are Latin squares
// in three. Sources: Box, Hunter 1961, Technometrics 3(3), 311-351; Franklin 1984, Technometrics 26(3), 225-232; Rao 1947.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::design {

struct ConditionSet;

struct Relation {
    std::vector<std::pair<std::string, int>> sum;  ///< factor and coefficient
    int modulo = 2, remainder = 0;
};

/// [{"sum": ["a", "b"] or {"a": 1, "b": 2}, "modulo": 3, "remainder": 0}, ...]. Throws Error.
std::vector<Relation> read_fraction(const JsonCursor& json,
                                    const std::vector<std::string>& factors);

/// Of all conditions of the set, by number, ascending: those wanted. Throws Error when they are too many or none.
std::vector<long> wanted_conditions(const ConditionSet& set, int seed);

/// The row of the table, then the level of each factor, of a condition by number: the last factor changes fastest.
std::vector<int> levels_of(const ConditionSet& set, long condition);

/// How often levels and pairs of levels come in a choice of conditions.
struct Balance {
    struct Share {
        std::string name;          ///< of the factor, or "conditions" for the rows of the table
        long least = 0, most = 0;  ///< how often a level of it comes
    };
    long wanted = 0, all = 0;
    std::vector<Share> factors;
    long pair_least = 0, pair_most = 0;  ///< how often two levels of two factors meet
    int strength = 0;  ///< so many factors, whichever, have all their combinations equally often

    std::string text() const;
};
Balance balance_of(const ConditionSet& set, int seed);

}  // namespace risorius::design
