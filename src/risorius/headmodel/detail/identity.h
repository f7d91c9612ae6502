// SPDX-License-Identifier: MIT
/// \file
/// The identity of a head: sex, age, shape parameters in standard deviations, and colours. It is read from a file, drawn by a seed, or set.
///
/// A file names only what differs from the average adult:
///   {"format": "risorius-identity", "version": 1, "name": "ada", "sex": -1, "age": 34, "shape": {"lips": 1.2}, "skin": "tan"}
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/headmodel/detail/identity_hair.h"
#include "risorius/headmodel/detail/tables.h"

namespace risorius::headmodel {

inline constexpr Range kSexRange{-1, 1}, kAgeRange{20, 80}, kShapeRange{-2, 2}, kHairRange{-10, 40},
    kRednessRange{-3, 3};
/// Of persons of the population: those drawn are within 2.5, and caricatures beyond.
inline constexpr Range kPersonShapeRange{-4, 4};

enum class Model { kFamily = 1, kPopulation = 2 };

struct Identity {
    std::string name = "adult";
    /// How shapes are meant: as variations of the average adult, or as those from the mean of a sex, age and ancestry.
    Model model = Model::kFamily;
    /// Name of an ancestry -> its share; only of the population. The shares sum to 1, or there are none.
    std::map<std::string, double> ancestry;
    double sex = 0;   ///< -1 the average woman, 1 the average man
    double age = 40;  ///< years
    /// Name of a parameter -> its value in standard deviations; a parameter that is absent is 0
    std::map<std::string, double> shape;
    std::string skin = "fair", iris = "blue", hair = "brown";  ///< names of the tones table
    /// The tone of the skin by its pigments, instead of by name: see skin_pigments.h
    std::optional<double> melanin;
    double haemoglobin = 0;  ///< only with melanin
    double lipstick = 0;     ///< 0..1, how much the lips are painted red
    double freckles = 0.15;  ///< 0..1, as the others below
    double scalp_hair = 0.6;
    double hairline = 0;  ///< mm: how much higher than average the hair begins on the forehead
    double temples = 0;   ///< mm: how much farther it recedes at the temples
    double beard = 0;
    IdentityHair hairdo;
};

/// Returns the names of the parameters of the table except sex and age, in its order.
std::vector<std::string> shape_parameters(const DesignTables& tables, Model model = Model::kFamily);

/// Returns the names that the tone of a part may have. `part`: skin, iris or hair.
std::vector<std::string> tone_names(const DesignTables& tables, const std::string& part);

/// A function that returns the place of a field for error messages: "ada.json:/age", or an option by option_name().
using PlaceOf = std::function<std::string(const std::string& field)>;

/// Throws Error on unknown parameters or tones and on values beyond the ranges above.
void check_identity(const Identity& identity, const DesignTables& tables, const PlaceOf& place);

/// Reads an identity. Throws Error as above; the message names the place in the file.
Identity read_identity(const std::filesystem::path& file, const DesignTables& tables);
Json identity_json(const Identity& identity);

/// Returns the sorted names of the files in models/identities.
std::vector<std::string> named_identities();
std::filesystem::path identity_file(const std::string& name);  ///< whether the file exists or not

/// Draws an identity at random; the same seed gives the same identity on every machine. Shape parameters have standard deviation
/// 1, as in adults, and are limited to magnitude 2.
Identity random_identity(unsigned seed, const DesignTables& tables);

}  // namespace risorius::headmodel
