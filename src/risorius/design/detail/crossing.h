// SPDX-License-Identifier: MIT
/// \file
/// Which conditions of a crossing are used: all, a regular fraction, or a random choice; and how balanced the choice is.
///
/// Levels are numbered from 0 in the order of the file. A relation keeps the conditions in which
///
///     sum of coefficient * number of the level  =  remainder   (modulo m)
///
/// With m the number of levels, a prime, k independent relations keep 1/m^k of the crossing, and every choice of t factors is
/// met equally often in each combination when each sum (and each combination of sums) has more than t factors in it: a regular
/// fractional factorial of resolution t + 1, an orthogonal array of strength t. Sums of two factors of m levels are Latin squares
/// in three. Sources: Box, Hunter 1961, Technometrics 3(3), 311-351; Franklin 1984, Technometrics 26(3), 225-232; Rao 1947.
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

/// The numbers of the conditions that are used, ascending. Throws Error when there are too many or none.
std::vector<long> wanted_conditions(const ConditionSet& set, int seed);

/// The row of the table, then the level of each factor, for the number of a condition. The last factor changes fastest.
std::vector<int> levels_of(const ConditionSet& set, long condition);

/// How often levels and pairs of levels occur in a choice of conditions.
struct Balance {
    struct LevelCount {
        std::string name;       ///< the factor, or "conditions" for the rows of the table
        long min = 0, max = 0;  ///< how often the rarest and the most frequent level occur
    };
    long used = 0, all = 0;  ///< conditions
    std::vector<LevelCount> factors;
    long pair_min = 0, pair_max = 0;  ///< the same for pairs of levels of two factors
    /// Any choice of this many factors has all combinations of levels equally often.
    int strength = 0;

    std::string text() const;
};
Balance balance_of(const ConditionSet& set, int seed);

}  // namespace risorius::design
