// SPDX-License-Identifier: MIT
// Casts, and persons between others.
#include "risorius/headmodel/detail/cast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "risorius/headmodel/detail/deform_head.h"
#include "risorius/headmodel/detail/population.h"
#include "temporary_folder.h"

namespace risorius::headmodel {
namespace {

const DesignTables& cast_tables() {
    static const DesignTables read = read_design_tables(models_folder() / "adult/design");
    return read;
}

std::string text_of(const Identity& identity) { return identity_json(identity).dump(); }

TEST(Cast, IsBalancedAndNoTwoAreAlike) {
    const CastOptions options{
        .count = 6, .seed = 3, .balance = {"sex", "age"}, .ancestry = "european"};
    const auto cast = choose_cast(options, cast_tables());
    ASSERT_EQ(cast.size(), 6u);
    int women = 0, young = 0, old = 0;
    for (const CastMember& one : cast) {
        women += one.identity.sex < 0;
        young += one.identity.age < 35;
        old += one.identity.age >= 55;
        EXPECT_GE(one.nearest_sd, kLeastDistance) << one.identity.name;
        EXPECT_EQ(one.identity.ancestry.begin()->first, "european");
        for (const CastMember& other : cast) {
            if (&one == &other) continue;
            EXPECT_GE(distance_sd(one.identity, other.identity, cast_tables()), one.nearest_sd);
        }
    }
    EXPECT_EQ(women, 3);
    EXPECT_EQ(young, 2);
    EXPECT_EQ(old, 2);
    // The cast of two is the beginning of the cast of six.
    CastOptions two = options;
    two.count = 2;
    const auto again = choose_cast(two, cast_tables());
    for (std::size_t k = 0; k < 2; ++k)
        EXPECT_EQ(text_of(cast[k].identity), text_of(again[k].identity));
    const std::string table = cast_table({cast[0], cast[1]}, cast_tables());
    EXPECT_TRUE(
        table.starts_with("name\tsex\tage\tancestry\tskin_ita_deg\tseed\tnearest_sd\tnearest_"
                          "to\tbitragion_breadth_mm\t"))
        << table;
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
}

/// Half of them women, a third in each of three bands of age, a quarter of each ancestry.
TEST(Cast, NamedPeopleOfThePopulationAreBalancedAndDiffer) {
    std::vector<Identity> people;
    std::map<std::string, int> of_ancestry;
    int women = 0, young = 0, old = 0;
    for (const std::string& name : named_identities()) {
        const Identity one = read_identity(identity_file(name), cast_tables());
        if (one.model != Model::kPopulation) continue;
        EXPECT_EQ(one.name, name);
        ++of_ancestry[one.ancestry.begin()->first];
        women += one.sex < 0;
        young += one.age < 35;
        old += one.age >= 55;
        for (const Identity& other : people)
            EXPECT_GE(distance_sd(one, other, cast_tables()), kLeastDistance)
                << name << " " << other.name;
        people.push_back(one);
    }
    EXPECT_EQ(people.size(), 24u);
    EXPECT_EQ(women, 12);
    EXPECT_EQ(young, 8);
    EXPECT_EQ(old, 8);
    for (const auto& [ancestry, count] : of_ancestry) EXPECT_EQ(count, 6) << ancestry;
    const HeadModel average = make_head(cast_tables());
    for (std::size_t k = 0; k < people.size(); k += 5)
        EXPECT_FALSE(runs_through_itself(deform_head(average, cast_tables(), people[k])))
            << people[k].name;
}

TEST(Cast, ErrorsNameTheOption) {
    const auto message = [](const CastOptions& options) {
        return message_of([&] { choose_cast(options, cast_tables()); });
    };
    EXPECT_EQ(message({.count = 1}), "cast: expected 2 to 200 persons, found 1");
    EXPECT_NE(message({.count = 4, .balance = {"ages"}}).find("(did you mean \"age\"?)"),
              std::string::npos);
    EXPECT_EQ(message({.count = 4, .balance = {"age"}, .age = 30}),
              "balance: expected age that is not set by age, found both");
}

TEST(Morph, BeginsAtOneAndEndsAtTheOther) {
    // Half as distinct as drawn, nothing of them is at the limit of kPersonShapeRange, where steps would be shorter.
    const Identity a = exaggerate(
                       random_person(1, {.age = 25, .ancestry = "african"}, cast_tables()), 0.5),
                   b = exaggerate(
                       random_person(2, {.age = 40, .ancestry = "european"}, cast_tables()), 0.5);
    EXPECT_EQ(text_of(morph(a, b, 0)), text_of(a));
    EXPECT_EQ(text_of(morph(a, b, 1)), text_of(b));
    const Identity middle = morph(a, b, 0.5);
    EXPECT_DOUBLE_EQ(middle.age, (a.age + b.age) / 2);
    EXPECT_EQ(middle.ancestry,
              (std::map<std::string, double>{{"african", 0.5}, {"european", 0.5}}));
    for (const auto& [parameter, value] : middle.shape)
        EXPECT_NEAR(value, (a.shape.at(parameter) + b.shape.at(parameter)) / 2, 1e-12);
    // Equal steps, and as far from the one as from the other
    EXPECT_NEAR(distance_sd(a, middle, cast_tables()), distance_sd(middle, b, cast_tables()), 1e-9);
    EXPECT_EQ(message_of([&] { morph(a, Identity{}, 0.5); }),
              "morph: expected persons of one model, found seed1 and adult of two");
}

TEST(Average, OfAPersonIsThePersonAndOfManyIsNearNobody) {
    const Identity one =
        random_person(1, {.sex = 1, .age = 40, .ancestry = "european"}, cast_tables());
    EXPECT_EQ(average_of({one, one}).shape, one.shape);
    std::vector<Identity> many;
    for (unsigned seed = 10001; seed <= 10060; ++seed)  // in no row, where the sex is exaggerated
        many.push_back(
            random_person(seed, {.sex = 1, .age = 40, .ancestry = "european"}, cast_tables()));
    const Identity mean = average_of(many);
    EXPECT_NEAR(mean.age, 40, 1e-9);
    // The mean of n persons varies by 1 / sqrt(n) of what a person does.
    EXPECT_LT(distance_sd(mean, exaggerate(one, 0), cast_tables()), 0.2);
}

TEST(Exaggerate, MultipliesWhatDistinguishes) {
    const Identity one = random_person(4, {}, cast_tables()), norm = exaggerate(one, 0);
    const double distance = distance_sd(one, norm, cast_tables());
    EXPECT_NEAR(distance_sd(exaggerate(one, 0.5), norm, cast_tables()), 0.5 * distance, 0.02);
    EXPECT_NEAR(distance_sd(exaggerate(one, 1.5), norm, cast_tables()), 1.5 * distance, 0.1);
    EXPECT_EQ(exaggerate(one, 1.5).sex, one.sex);
    EXPECT_EQ(text_of(exaggerate(one, 1)), text_of(one));
}

}  // namespace
}  // namespace risorius::headmodel
