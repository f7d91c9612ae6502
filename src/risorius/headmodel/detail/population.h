// SPDX-License-Identifier: MIT
/// \file
/// Persons of a population: what is usual at a sex, age and ancestry, and how people vary about it. Source of the numbers: population.csv.
///
/// A person's shape s is drawn as s_k = own_k e_k + sum over modes m of modes_km z_m, where e and z are independent standard normal
/// numbers. Its head has the shape s_k + usual_k.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "risorius/headmodel/detail/identity.h"

namespace risorius::headmodel {

/// Returns the shape of a person against the average head: that of sex, age and ancestry and that of the person, limited to kPersonShapeRange.
std::map<std::string, double> person_shape(const Identity& identity, const DesignTables& tables);

/// Whether a parameter makes a face uneven, so that it tells nothing of how two persons differ.
bool makes_uneven(const std::string& parameter);

/// What is decided before a person is drawn.
struct PersonChoice {
    std::optional<double> sex{}, age{};
    std::optional<std::string> ancestry{};
};

/// Draws a person; the same seed gives the same person on every machine. Seeds up to 9600 stand in rows of 48 (1 to 48, 49 to 96, ...): each
/// draws 96 forms, each with a tone of skin, and takes the one that is seen to differ most from the 23 before it in its row. What is chosen
/// replaces what the seed would give and changes nothing else of the form, but for what is usual in a sex. What makes people of rows
/// distinct is exaggerated, and so is what is usual in their sex. Shapes are limited to magnitude 2.5.
Identity random_person(unsigned seed, const PersonChoice& choice, const DesignTables& tables);

}  // namespace risorius::headmodel
