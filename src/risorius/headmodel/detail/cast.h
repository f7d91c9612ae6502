// SPDX-License-Identifier: MIT
/// \file
/// Casts of different persons, and persons between, in the middle of and beyond others, all in the space of identities.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/headmodel/detail/identity.h"

namespace risorius::headmodel {

struct CastOptions {
    int count = 0;      ///< 2 to 200 persons
    unsigned seed = 0;  ///< same seed, same cast
    /// What is to be equally frequent: "sex", "age" (20 to 34, 35 to 54 and 55 to 75 years) and "ancestry".
    std::vector<std::string> balance{};
    /// What all have in common. Throws Error if one of them is also to be balanced.
    std::optional<double> sex{}, age{};
    std::optional<std::string> ancestry{};
};

struct CastMember {
    Identity identity;
    unsigned seed = 0;         ///< draws the person again, with the same sex, age and ancestry
    double nearest_sd = 0;     ///< distance of the person most like this one
    std::string nearest_to{};  ///< who that is
};

/// Chooses persons that differ: of kCandidates persons drawn for each place the one farthest from all chosen before. Persons are named
/// p01, p02, ... Throws Error on counts and names beyond those above.
std::vector<CastMember> choose_cast(const CastOptions& options, const DesignTables& tables);

/// Least distance of two persons of a cast, standard deviations; two persons at random are 1.4 apart.
inline constexpr double kLeastDistance = 1;

/// Returns the root mean square of the differences of all parameters between two persons, in standard deviations, with what is usual at their sex, age
/// and ancestry, without what makes a face uneven.
double distance_sd(const Identity& a, const Identity& b, const DesignTables& tables);

/// Writes the table for a methods section: tab-separated, a line for each person.
std::string cast_table(const std::vector<CastMember>& cast, const DesignTables& tables);

/// Returns the person at `share` of the way from a to b, which are both of the same model. Below 0 and above 1 it lies beyond them. Tones, which are
/// names, are those of the nearer one. Throws Error on different models.
Identity morph(const Identity& a, const Identity& b, double share);

/// Returns the mean of persons of the same model. Tones are those of the most, or of the first of equals.
Identity average_of(const std::vector<Identity>& persons);

/// Multiplies what distinguishes a person from the mean of the same sex, age and ancestry: 1.5 gives a caricature, 0.5 an
/// anti-caricature, 0 the mean.
Identity exaggerate(const Identity& person, double factor);

}  // namespace risorius::headmodel
