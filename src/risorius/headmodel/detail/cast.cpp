// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/cast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/headmodel/detail/deform_head.h"
#include "risorius/headmodel/detail/draw.h"
#include "risorius/headmodel/detail/population.h"
#include "risorius/headmodel/detail/skin_pigments.h"

namespace risorius::headmodel {
namespace {

constexpr int kCandidates = 24;
constexpr int kFewest = 2, kMost = 200;

/// Numbers of the body of a person that are blended like lengths.
constexpr double Identity::*kBlended[] = {
    &Identity::sex,      &Identity::age,     &Identity::freckles, &Identity::scalp_hair,
    &Identity::hairline, &Identity::temples, &Identity::beard,    &Identity::lipstick};
const std::pair<double IdentityHair::*, Range> kBlendedHair[] = {
    {&IdentityHair::age_lines, kShareRange},       {&IdentityHair::brow_density, kBrowDensityRange},
    {&IdentityHair::brow_width, kBrowWidthRange},  {&IdentityHair::skin_gloss, kSkinGlossRange},
    {&IdentityHair::complexion, kComplexionRange}, {&IdentityHair::lock_length, kLockLengthRange},
    {&IdentityHair::lock_wave, kShareRange},       {&IdentityHair::fringe, kShareRange},
    {&IdentityHair::parting, kPartingRange},       {&IdentityHair::mottling, kShareRange}};
constexpr std::string Identity::*kTones[] = {&Identity::skin, &Identity::iris, &Identity::hair};

/// Every combination of what is balanced, one after the other; the cast goes round it.
std::vector<PersonChoice> places_of(const CastOptions& options, const DesignTables& tables,
                                    Draw& draw) {
    const std::set<std::string> balance(options.balance.begin(), options.balance.end());
    std::vector<PersonChoice> places{{options.sex, options.age, options.ancestry}};
    const auto spread = [&](const auto& values, auto member) {
        std::vector<PersonChoice> more;
        for (const PersonChoice& place : places)
            for (const auto& value : values) {
                more.push_back(place);
                more.back().*member = value;
            }
        places = more;
    };
    if (balance.count("ancestry")) spread(tables.ancestries, &PersonChoice::ancestry);
    // The middle of each band stands for it until a person is drawn.
    if (balance.count("age")) spread(std::vector<double>{27, 45, 65}, &PersonChoice::age);
    if (balance.count("sex")) spread(std::vector<double>{-1, 1}, &PersonChoice::sex);
    // A cast that does not go round fully takes places evenly, not the first ones.
    for (std::size_t k = places.size(); k > 1; --k)
        std::swap(places[k - 1],
                  places[static_cast<std::size_t>(draw.even() * static_cast<double>(k))]);
    return places;
}

void check(const CastOptions& options, const DesignTables& tables) {
    if (options.count < kFewest || options.count > kMost)
        throw Error(option_name("cast"), "2 to 200 persons", std::to_string(options.count));
    const std::vector<std::string> names{"age", "ancestry", "sex"};
    for (const std::string& name : options.balance) {
        index_of_name(option_name("balance"), name, names);
        if ((name == "sex" && options.sex) || (name == "age" && options.age) ||
            (name == "ancestry" && options.ancestry))
            throw Error(option_name("balance"), name + " that is not set by " + option_name(name),
                        "both");
    }
    if (options.ancestry)
        index_of_name(option_name("ancestry"), *options.ancestry, tables.ancestries);
}

Identity drawn_for(const PersonChoice& place, bool balanced_age, unsigned seed,
                   const DesignTables& tables) {
    PersonChoice choice = place;
    if (balanced_age) {
        // An age within the band, from the seed
        Draw draw(seed ^ 0x5bd1e995u);
        const double from = *place.age < 35   ? 20
                            : *place.age < 55 ? 35
                                              : 55,
                     to = *place.age < 35   ? 34
                          : *place.age < 55 ? 54
                                            : 75;
        choice.age = std::round(from + (to - from) * draw.even());
    }
    return random_person(seed, choice, tables);
}

void check_models(const std::vector<Identity>& persons, const std::string& option) {
    for (const Identity& person : persons)
        if (person.model != persons.front().model)
            throw Error(option_name(option), "persons of one model",
                        persons.front().name + " and " + person.name + " of two");
}

void keep_in_range(Identity& person) {
    const bool of_population = person.model == Model::kPopulation;
    const Range range = of_population ? kPersonShapeRange : kShapeRange;
    for (auto& [parameter, value] : person.shape) value = std::clamp(value, range.min, range.max);
    person.sex = std::clamp(person.sex, kSexRange.min, kSexRange.max);
    person.age = std::clamp(person.age, kAgeRange.min, kAgeRange.max);
    for (const auto member :
         {&Identity::freckles, &Identity::scalp_hair, &Identity::beard, &Identity::lipstick})
        person.*member = std::clamp(person.*member, 0.0, 1.0);
    for (const auto member : {&Identity::hairline, &Identity::temples})
        person.*member = std::clamp(person.*member, kHairRange.min, kHairRange.max);
    double shares = 0;
    for (auto& [name, share] : person.ancestry) shares += share = std::max(0.0, share);
    for (auto& [name, share] : person.ancestry) share /= shares;
    std::erase_if(person.ancestry, [](const auto& entry) { return entry.second == 0; });
}

/// Persons by their weights, which sum to 1.
Identity blended(const std::vector<Identity>& persons, const std::vector<double>& weights) {
    Identity out = persons.front();
    for (const auto member : kBlended) out.*member = 0;
    out.shape.clear();
    out.ancestry.clear();
    for (std::size_t k = 0; k < persons.size(); ++k) {
        for (const auto member : kBlended) out.*member += weights[k] * (persons[k].*member);
        for (const auto& [parameter, value] : persons[k].shape)
            out.shape[parameter] += weights[k] * value;
        for (const auto& [name, share] : persons[k].ancestry)
            out.ancestry[name] += weights[k] * share;
    }
    // Of names, the one with the greatest weight; the first of equals
    const auto choose = [&](auto&& name_of) {
        std::map<std::string, double> votes;
        for (std::size_t k = 0; k < persons.size(); ++k) votes[name_of(persons[k])] += weights[k];
        for (const Identity& person : persons)
            if (votes[name_of(person)] > votes[name_of(out)]) name_of(out) = name_of(person);
    };
    // Pigments are blended where everybody has them; else there is a name.
    double melanin = 0, haemoglobin = 0;
    bool by_pigments = true;
    out.hairdo.grey = 0;
    for (std::size_t k = 0; k < persons.size(); ++k) {
        // White hairs come with the blended age where one of them has as many as come with age.
        const std::optional<double>& grey = persons[k].hairdo.grey;
        out.hairdo.grey = grey && out.hairdo.grey
                              ? std::optional(*out.hairdo.grey + weights[k] * *grey)
                              : std::nullopt;
        by_pigments = by_pigments && persons[k].melanin;
        melanin += weights[k] * persons[k].melanin.value_or(0);
        haemoglobin += weights[k] * persons[k].haemoglobin;
    }
    if (out.hairdo.grey) out.hairdo.grey = std::clamp(*out.hairdo.grey, 0.0, 1.0);
    out.melanin.reset();
    if (by_pigments) out.melanin = std::clamp(melanin, 0.0, 1.0);
    out.haemoglobin =
        std::clamp(by_pigments ? haemoglobin : 0.0, kRednessRange.min, kRednessRange.max);
    for (const auto member : kTones) choose([&](auto& person) -> auto& { return person.*member; });
    choose([](auto& person) -> auto& { return person.hairdo.style; });
    choose([](auto& person) -> auto& { return person.hairdo.hairline_form; });
    choose([](auto& person) -> auto& { return person.hairdo.beard_form; });
    choose([](auto& person) -> auto& { return person.hairdo.garment; });
    for (const auto& [member, range] : kBlendedHair) {
        out.hairdo.*member = 0;
        for (std::size_t k = 0; k < persons.size(); ++k)
            out.hairdo.*member += weights[k] * (persons[k].hairdo.*member);
        out.hairdo.*member = std::clamp(out.hairdo.*member, range.min, range.max);
    }
    keep_in_range(out);
    return out;
}

}  // namespace

double distance_sd(const Identity& a, const Identity& b, const DesignTables& tables) {
    const auto of_a = person_shape(a, tables), of_b = person_shape(b, tables);
    double sum = 0;
    int count = 0;
    for (const auto& [parameter, value] : of_a) {
        if (makes_uneven(parameter)) continue;
        const double difference = value - of_b.at(parameter);
        sum += difference * difference;
        ++count;
    }
    return std::sqrt(sum / count);
}

std::vector<CastMember> choose_cast(const CastOptions& options, const DesignTables& tables) {
    check(options, tables);
    Draw draw(options.seed);
    const auto places = places_of(options, tables, draw);
    const bool balanced_age =
        std::find(options.balance.begin(), options.balance.end(), "age") != options.balance.end();
    const HeadModel average = make_form(tables);
    std::vector<CastMember> cast;
    for (int k = 0; k < options.count; ++k) {
        const PersonChoice& place = places[static_cast<std::size_t>(k) % places.size()];
        CastMember best;
        double farthest = -1;
        for (int c = 0; c < kCandidates; ++c) {
            const auto seed = static_cast<unsigned>(draw.even() * 1e9);
            const Identity person = drawn_for(place, balanced_age, seed, tables);
            double nearest = std::numeric_limits<double>::infinity();
            for (const CastMember& other : cast)
                nearest = std::min(nearest, distance_sd(person, other.identity, tables));
            if (nearest <= farthest) continue;
            farthest = nearest;
            best = {person, seed};
        }
        if (farthest < kLeastDistance)
            throw Error(option_name("cast"), "fewer persons: all are to differ",
                        std::to_string(options.count));
        deform_within_spread(average, tables, best.identity);
        best.identity.name = (k < 9 ? "p0" : "p") + std::to_string(k + 1);
        cast.push_back(best);
    }
    for (CastMember& member : cast) {
        member.nearest_sd = std::numeric_limits<double>::infinity();
        for (const CastMember& other : cast) {
            if (&other == &member) continue;
            const double distance = distance_sd(member.identity, other.identity, tables);
            if (distance >= member.nearest_sd) continue;
            member.nearest_sd = distance;
            member.nearest_to = other.identity.name;
        }
    }
    return cast;
}

std::string cast_table(const std::vector<CastMember>& cast, const DesignTables& tables) {
    std::string text = "name\tsex\tage\tancestry\tskin_ita_deg\tseed\tnearest_sd\tnearest_to";
    for (const Measure& measure : tables.measures) {
        std::string name = measure.name;
        std::replace(name.begin(), name.end(), ' ', '_');
        text += "\t" + name + "_mm";
    }
    text += "\n";
    const HeadModel average = make_form(tables);
    for (const CastMember& member : cast) {
        const Identity& who = member.identity;
        text += who.name + "\t" + (who.sex < 0 ? "female" : "male") + "\t" +
                format_number(who.age) + "\t" + who.ancestry.begin()->first + "\t" +
                format_number(std::round(skin_colours(who, tables).ita_deg)) + "\t" +
                std::to_string(member.seed) + "\t" +
                format_number(to_hundredths(member.nearest_sd)) + "\t" + member.nearest_to;
        for (const MeasureScore& m :
             measure_head(deform_head(average, tables, who), tables, who.sex))
            text += "\t" + format_number(std::round(10 * m.length_mm) / 10);
        text += "\n";
    }
    return text;
}

Identity morph(const Identity& a, const Identity& b, double share) {
    check_models({a, b}, "morph");
    if (share == 0) return a;
    if (share == 1) return b;
    Identity out = blended({a, b}, {1 - share, share});
    out.name = a.name + "_" + b.name;
    return out;
}

Identity average_of(const std::vector<Identity>& persons) {
    if (persons.empty()) throw Error(option_name("average"), "one person or more", "none");
    check_models(persons, "average");
    Identity out = blended(
        persons, std::vector<double>(persons.size(), 1.0 / static_cast<double>(persons.size())));
    out.name = "average";
    return out;
}

Identity exaggerate(const Identity& person, double factor) {
    Identity out = person;
    for (auto& [parameter, value] : out.shape) value *= factor;
    keep_in_range(out);
    return out;
}

}  // namespace risorius::headmodel
