// SPDX-License-Identifier: MIT
// Proportions of the mean persons of the population against published means.
#include <gtest/gtest.h>

#include <tuple>

#include "risorius/headmodel/detail/deform_head.h"

namespace risorius::headmodel {
namespace {

/// Means of Europeans of 30 years: fissures 30.7 and 31.3 mm long, 10.9 and 10.8 high, noses 50.6 and 54.8 (Farkas 1994), faces from
/// sellion to menton 112.4 and 122.3 (ANSUR II), with the nasion some 2.5 mm above the sellion.
TEST(Person, MeanFacesHaveTheProportionsOfAdults) {
    const DesignTables tables = read_design_tables(models_folder() / "adult/design");
    const HeadModel average = make_form(tables);
    for (const auto& [sex, fissure, open, nose, face] :
         {std::tuple{-1.0, 30.7, 10.9, 50.6, 114.9}, {1.0, 31.3, 10.8, 54.8, 124.8}}) {
        Identity person;
        person.model = Model::kPopulation;
        person.sex = sex;
        person.age = 30;
        person.ancestry["european"] = 1;
        const HeadModel head = deform_head(average, tables, person);
        const auto length = [&](const char* a, const char* b) {
            return (head.mesh.positions.row(head.landmarks.at(a)) -
                    head.mesh.positions.row(head.landmarks.at(b)))
                .norm();
        };
        EXPECT_NEAR(length("en_l", "ex_l"), fissure, 0.7) << sex;
        EXPECT_NEAR(length("ps_l", "pi_l"), open, 0.5) << sex;
        EXPECT_NEAR(length("n", "sn"), nose, 2) << sex;
        EXPECT_NEAR(length("n", "me"), face, 2) << sex;
    }
}

}  // namespace
}  // namespace risorius::headmodel
