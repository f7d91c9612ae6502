// SPDX-License-Identifier: MIT
/// \file
/// Selects conditions of a crossing (all combinations of the levels of some factors): all of them, a regular fraction, or a
/// random choice. Measures how balanced the selection is.
///
/// Levels are numbered from 0 in the order of the file. A relation keeps the conditions for which
///
///     sum of coefficient * number of the level  =  remainder   (modulo m)
///
/// Let m be the number of levels, a prime. Then k independent relations keep 1/m^k of the crossing. If each sum, and each
/// combination of sums, has more than t factors, all combinations of levels of any t factors occur equally often: a regular
/// fractional factorial of resolution t + 1, an orthogonal array of strength t. For three factors of m levels, one relation gives
/// a Latin square. Sources: Box, Hunter 1961, Technometrics 3(3), 311-351; Franklin 1984, Technometrics 26(3), 225-232; Rao 1947.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::design {

struct ConditionSet;

/// A linear relation between the levels of factors.
struct Relation {
    std::vector<std::pair<std::string, int>> sum;  ///< factors with their coefficients
    int modulo = 2, remainder = 0;
};

/// Reads [{"sum": ["a", "b"] or {"a": 1, "b": 2}, "modulo": 3, "remainder": 0}, ...]. Throws Error.
std::vector<Relation> read_fraction(const JsonCursor& json,
                                    const std::vector<std::string>& factors);

/// Returns the numbers of the conditions that are used, ascending. Throws Error when there are too many or none.
std::vector<long> wanted_conditions(const ConditionSet& set, int seed);

/// Returns, for the number of a condition, the row of the table, followed by the level of each factor. The last factor changes
/// fastest.
std::vector<int> levels_of(const ConditionSet& set, long condition);

/// How often levels, and pairs of levels, occur among the conditions that are used.
struct Balance {
    struct LevelCount {
        std::string name;       ///< name of the factor, or "conditions" for the rows of the table
        long min = 0, max = 0;  ///< frequency of the rarest and of the most frequent level
    };
    long used = 0, all = 0;  ///< numbers of conditions
    std::vector<LevelCount> factors;
    long pair_min = 0, pair_max = 0;  ///< the same for pairs of levels of two factors
    /// The strength: for any choice of this many factors, all combinations of their levels occur equally often.
    int strength = 0;

    std::string text() const;
};
Balance balance_of(const ConditionSet& set, int seed);

}  // namespace risorius::design
