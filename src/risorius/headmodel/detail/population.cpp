// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/population.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "risorius/core/known_names.h"
#include "risorius/headmodel/detail/draw.h"

namespace risorius::headmodel {
namespace {

constexpr double kCut = 2.5;  ///< standard deviations; beyond them nobody is drawn
constexpr double kBaldTemples_mm = 11;
constexpr double kYoungest = 20, kOldest = 75;  ///< years
constexpr unsigned kHairSequence = 0x5eed0000, kSkinSequence = 0x5c1d0000,
                   kFormSequence = 0x0f050001;

/// Where a seed stands among all persons: seeds in a row take turns in sex and fill three directions, 0..1, evenly, so that few
/// of them share age, ancestry and hair. The steps are square roots and the golden ratio: the fractions of their multiples are spread evenly.
struct Place {
    bool woman;
    double age, ancestry, hair;
};

Place place_of(unsigned seed) {
    const auto along = [&](double step) {
        const double at = 0.5 + step * seed;
        return at - std::floor(at);
    };
    return {seed % 2 == 1, along(std::numbers::sqrt2), along(std::numbers::phi),
            along(std::numbers::sqrt3)};
}

/// Values of all parameters of the population, in its order.
using Form = std::vector<double>;

double squared_distance(const Form& a, const Form& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

bool in_row(unsigned seed) {
    constexpr unsigned kLastInRows = 9600;
    return seed > 0 && seed <= kLastInRows;
}

/// A person of the sex, age and ancestry of a seed's place, and no more.
Identity placed_person(unsigned seed, const DesignTables& tables) {
    const Place place = place_of(seed);
    Identity person;
    person.model = Model::kPopulation;
    person.name = "seed" + std::to_string(seed);
    person.sex = place.woman ? -1 : 1;
    person.age = std::round(kYoungest + (kOldest - kYoungest) * place.age);
    person.ancestry[tables.ancestries[static_cast<std::size_t>(
        place.ancestry * static_cast<double>(tables.ancestries.size()))]] = 1;
    return person;
}

Form drawn_form(Draw& draw, const DesignTables& tables) {
    const auto normal = [&] { return std::clamp(draw.normal(), -kCut, kCut); };
    std::vector<double> modes(tables.population.front().modes.size());
    for (double& mode : modes) mode = normal();
    Form form;
    for (const PopulationParameter& p : tables.population) {
        double value = p.own * normal();
        for (std::size_t m = 0; m < modes.size(); ++m) value += p.modes[m] * modes[m];
        form.push_back(to_hundredths(std::clamp(value, -kCut, kCut)));
    }
    return form;
}

/// The part of a form that is along what `change` says of each parameter, in its unit.
double part_along(const Form& form, double PopulationParameter::*change,
                  const DesignTables& tables) {
    double along = 0, square = 0;
    for (std::size_t k = 0; k < form.size(); ++k) {
        const double by = tables.population[k].*change;
        along += form[k] * by;
        square += by * by;
    }
    return along / square;
}

/// What makes a person of a row distinct is exaggerated, more so what is seen: 1.3 to 2.1 times, and half of what is far from the mean
/// is taken back, so that nothing leaves kCut. What is usual in the other sex or at another age is taken back instead, as those are
/// not exaggerated. How uneven a face is stays as it is in adults.
Form exaggerated(Form form, const DesignTables& tables) {
    constexpr double kTakenBack = 0.9;
    for (const auto change : {&PopulationParameter::sex, &PopulationParameter::late_age}) {
        const double part = kTakenBack * part_along(form, change, tables);
        for (std::size_t k = 0; k < form.size(); ++k)
            form[k] -= part * (tables.population[k].*change);
    }
    for (std::size_t k = 0; k < form.size(); ++k) {
        const PopulationParameter& p = tables.population[k];
        if (makes_uneven(p.name)) continue;
        const double seen = std::min(p.seen, 2.0), more = (1 + 0.55 * seen) * std::abs(form[k]),
                     from = 1.2 + 0.4 * seen,
                     soft = std::min(more, from) + 0.5 * std::max(0.0, more - from);
        form[k] = std::copysign(std::min(soft, kCut), form[k]);
    }
    for (double& value : form) value = to_hundredths(value);
    return form;
}

/// Tones that are usual, from the names of the tones table, in thirds.
struct Colours {
    std::vector<std::string> skin, iris, hair;
};

Colours colours_of(const std::string& ancestry) {
    if (ancestry == "african") return {{"brown", "dark"}, {"brown", "dark"}, {"black"}};
    if (ancestry == "east_asian") return {{"fair", "olive", "tan"}, {"brown", "dark"}, {"black"}};
    if (ancestry == "south_asian")
        return {{"brown", "olive", "tan"}, {"brown", "dark", "hazel"}, {"black"}};
    return {{"fair", "fair", "pale", "tan"},
            {"blue", "brown", "green", "grey", "hazel"},
            {"black", "blond", "brown", "brown", "red"}};
}

void draw_colours(Draw& draw, const std::string& ancestry, Identity& person) {
    const Colours colours = colours_of(ancestry);
    person.skin = draw.one_of(colours.skin);
    person.iris = draw.one_of(colours.iris);
    person.hair = draw.one_of(colours.hair);
    const bool light = person.skin == "pale" || person.skin == "fair";
    person.freckles = to_hundredths((light ? 0.5 : 0.1) * draw.even() * draw.even());
    person.beard = to_hundredths((person.sex > 0 ? 0.6 : 0) * draw.even());
    // Men lose hair with the years, some much and most little.
    const double lost = draw.even() * (person.sex > 0 ? std::max(0.0, person.age - 25) / 50 : 0.1);
    person.hairline = to_hundredths(std::clamp(3 * draw.normal() + 15 * lost, -8.0, 25.0));
    person.temples = to_hundredths(25 * lost);
    person.scalp_hair = to_hundredths(0.5 + 0.4 * draw.even());
}

std::string drawn_style(double place, const Identity& person, const std::string& ancestry,
                        const DesignTables& tables) {
    if (person.sex > 0 && person.temples > kBaldTemples_mm) return "bald_fringe";
    const auto column = static_cast<std::size_t>(
        std::find(tables.ancestries.begin(), tables.ancestries.end(), ancestry) -
        tables.ancestries.begin());
    const auto weight = [&](const HairChance& chance) {
        return (chance.sex > 0) == (person.sex > 0) ? chance.ancestry[column] : 0.0;
    };
    double sum = 0;
    for (const HairChance& chance : tables.hair_styles) sum += weight(chance);
    for (const HairChance& chance : tables.hair_styles) {
        if (place * sum < weight(chance)) return chance.style;
        place -= weight(chance) / sum;
    }
    return person.hairdo.style;
}

/// Hair and what age leaves on the skin. It has a sequence of its own: the form of a seed does not depend on it.
void draw_hair(unsigned seed, const std::string& ancestry, const DesignTables& tables,
               Identity& person) {
    Draw draw(seed + kHairSequence);
    person.hairdo.style = drawn_style(place_of(seed).hair, person, ancestry, tables);
    const double form = draw.even();
    const bool man = person.sex > 0;
    if (person.temples < kBaldTemples_mm)
        person.hairdo.hairline_form = form < 0.4   ? "even"
                                      : form < 0.7 ? (man ? "m" : "round")
                                      : form < 0.9 ? "widows_peak"
                                                   : "high";
    // Skin that aged earlier or later than most, by five years as a standard deviation. The lines grow with it as in the named
    // people, whose ages were read from pictures.
    const double seems = person.age + 5 * std::clamp(draw.normal(), -2.0, 2.0);
    person.hairdo.age_lines = to_hundredths(std::clamp((seems - 22) / 30, 0.0, 1.0));
    // The colour grows uneven with sun and years; shares from what a reader of ages makes of pictures.
    person.hairdo.mottling = to_hundredths(0.95 * std::clamp(0.4 + (seems - 22) / 60, 0.3, 1.0));
    // In the mean 26 % of grey hair at 53, 32 % at 58, 40 % at 63 years (Panhard et al. 2012).
    const double greying = person.age + 10 * std::clamp(draw.normal(), -2.0, 2.0);
    double grey = std::clamp((greying - 40) / 50, 0.0, 1.0);
    // Many colour their hair once it is grey, women more often than men; the shares are estimates.
    const double coloured = draw.even(), colour = draw.even();
    if (grey > 0.05 && coloured < (man ? 0.1 : 0.55)) {
        grey *= 0.15;
        if (ancestry == "european")
            person.hair = colour < 0.45  ? "brown"
                          : colour < 0.7 ? "blond"
                          : colour < 0.8 ? "red"
                                         : "black";
        else if (ancestry != "african")
            person.hair = colour < 0.4 ? "brown" : "black";
    }
    person.hairdo.grey = to_hundredths(grey);
    person.hairdo.seed = static_cast<int>(seed % 100000) + 1;
    // Brows of women are thinner, and often plucked.
    const double brow = std::clamp(draw.normal(), -2.0, 2.0),
                 height = std::clamp(draw.normal(), -2.0, 2.0);
    person.hairdo.brow_density =
        to_hundredths(std::min((man ? 1.25 : 1.1) * std::exp(0.5 * brow), kBrowDensityRange.max));
    person.hairdo.brow_width =
        to_hundredths(std::min((man ? 1.15 : 0.65) * std::exp(0.32 * height), kBrowWidthRange.max));
    // Seven of ten women paint their lips, and those of the others are redder than men's; estimates.
    const double painted = draw.even(), red = draw.even();
    if (!man) person.lipstick = painted < 0.7 ? to_hundredths(0.4 + 0.4 * red) : 0.25;
    // Of men six in ten are shaved or have stubble.
    const double kind = draw.even(), growth = draw.even();
    if (man && kind >= 0.6) {
        person.beard = to_hundredths(0.7 + 0.3 * growth);
        person.hairdo.beard_form = kind < 0.76   ? "full"
                                   : kind < 0.85 ? "moustache"
                                   : kind < 0.94 ? "goatee"
                                                 : "jawline";
    }
    // How hair is worn: any length and parting; waves are rare in East Asia and usual in Africa. Estimates.
    const double length = draw.even(), wave = draw.even(), parting = draw.even();
    person.hairdo.lock_length = to_hundredths(0.6 + 0.8 * length);
    person.hairdo.lock_wave =
        to_hundredths(ancestry == "african"      ? 0.4 + 0.6 * wave
                      : ancestry == "east_asian" ? 0.3 * wave
                                                 : std::max(0.0, 1.8 * wave - 0.8));
    person.hairdo.parting = to_hundredths(4 * parting - 2);
    const double fringe = draw.even() * (man ? 1.4 : 1);
    const std::string& style = person.hairdo.style;
    // A fringe of curls is rare.
    if (fringe < 0.5 && person.hairdo.lock_wave < 0.5 &&
        (style == "bob" || style == "short_parted"))
        person.hairdo.fringe = to_hundredths(0.4 + 1.2 * fringe);
    // Of men who go bald, one in five shaves his head, and one in five keeps a thin crop. Estimates.
    const double bald = draw.even();
    if (style == "bald_fringe" && bald < 0.4) {
        person.hairdo.hairline_form = "receding";
        person.hairdo.style = bald < 0.2 ? "shaven" : "crop";
    }
}

/// Melanin of an ancestry: mean and spread of facial skin as in ISSA (2025), for South Asian faces an estimate.
struct Melanin {
    double mean, sd;
};

Melanin melanin_of(const std::string& ancestry) {
    if (ancestry == "african") return {0.80, 0.16};
    if (ancestry == "east_asian") return {0.27, 0.10};
    if (ancestry == "south_asian") return {0.47, 0.14};
    return {0.20, 0.10};
}

/// The tone of the skin by its pigments, and how much it shines: less with the years (Pochi et al. 1979). It has a sequence of its
/// own, another one for each draw of a form.
void draw_skin(unsigned seed, unsigned which_form, const std::string& ancestry, Identity& person) {
    Draw draw(seed + kSkinSequence + which_form * kFormSequence);
    const auto normal = [&] { return std::clamp(draw.normal(), -2.0, 2.0); };
    const Melanin melanin = melanin_of(ancestry);
    person.melanin = to_hundredths(std::clamp(melanin.mean + melanin.sd * normal(), 0.0, 1.0));
    person.haemoglobin = to_hundredths(std::clamp(normal(), -1.5, 1.5));
    const double dry = 1 - 0.3 * std::clamp((person.age - 40) / 40, 0.0, 1.0);
    person.hairdo.skin_gloss = to_hundredths(dry * (0.75 + 0.15 * normal()));
}

/// What tells a person from others at first sight: the form of its head, sex, age and ancestry included, as much of it as is seen,
/// and, in the same unit, the tone of its skin and its years. The weights of these two are near those of regressions of what a face
/// recogniser tells of pairs: 17 and 0.39 (1380 pairs).
Form look_of(const Identity& person, const Form& usual, const Form& form,
             const DesignTables& tables) {
    constexpr double kMelanin = 17, kYears = 0.4;
    Form look{kMelanin * *person.melanin, kYears * person.age};
    for (std::size_t k = 0; k < form.size(); ++k)
        look.push_back(tables.population[k].seen * (usual[k] + form[k]));
    return look;
}

/// What a seed of a row wears: hair and beard. They do not depend on its form.
Identity worn_by(unsigned seed, const std::string& ancestry, const DesignTables& tables) {
    Draw draw(seed);
    Identity person = placed_person(seed, tables);
    drawn_form(draw, tables);
    draw_colours(draw, ancestry, person);
    draw_hair(seed, ancestry, tables, person);
    return person;
}

/// How much sex, beard and colour of the hair tell two people apart beside their looks, in the unit of these squared: those who share
/// them need other faces. From a regression of what a face recogniser tells of 1380 pairs.
double apart_by_hair(const Identity& a, const Identity& b) {
    constexpr double kSex = 190, kBeard = 150, kTone = 65;
    return (a.sex != b.sex ? kSex : 0) + (a.hairdo.beard_form != b.hairdo.beard_form ? kBeard : 0) +
           (a.hair != b.hair ? kTone : 0);
}

/// A person before in the row, as seen
struct Seen {
    Form look;
    Identity worn;
};

/// One of the forms that a seed draws; the first is 0.
struct FormDraw {
    Form form;
    unsigned which;
};

/// Whether what is a person's own makes a man look like a woman, or a woman like a man
bool against_sex(const Form& form, double sex, const DesignTables& tables) {
    double along = 0;
    for (std::size_t k = 0; k < form.size(); ++k)
        along += form[k] * tables.population[k].sex * tables.population[k].seen;
    return along * sex < 0;
}

/// Of some forms that a seed draws, each with a tone of skin, the one that is seen to differ most from the 23 before it in its row. Seeds
/// that a program draws at random are in no row. Forms that speak against the sex of the person are left out.
FormDraw form_in_row(unsigned seed, const DesignTables& tables) {
    constexpr unsigned kRow = 48, kBefore = 23, kCandidates = 96;
    if (!in_row(seed)) {
        Draw draw(seed);
        return {drawn_form(draw, tables), 0};
    }
    const unsigned first = (seed - 1) / kRow * kRow + 1;
    std::vector<Seen> looks;
    FormDraw best{};
    for (unsigned member = first; member <= seed; ++member) {
        Identity person = placed_person(member, tables);
        const std::string ancestry = person.ancestry.begin()->first;
        const auto shape = person_shape(person, tables);
        const Identity worn = worn_by(member, ancestry, tables);
        Form usual, best_look;
        for (const PopulationParameter& p : tables.population) usual.push_back(shape.at(p.name));
        double farthest = -1;
        for (unsigned c = 0; c < (looks.empty() ? 1 : kCandidates); ++c) {
            Draw draw(member + c * kFormSequence);
            Form form = exaggerated(drawn_form(draw, tables), tables);
            if (c > 0 && against_sex(form, person.sex, tables)) continue;
            draw_skin(member, c, ancestry, person);
            Form look = look_of(person, usual, form, tables);
            double nearest = std::numeric_limits<double>::infinity();
            for (const Seen& other : looks)
                nearest = std::min(
                    nearest, squared_distance(look, other.look) + apart_by_hair(worn, other.worn));
            if (nearest <= farthest) continue;
            farthest = nearest;
            best = {std::move(form), c};
            best_look = std::move(look);
        }
        looks.push_back({std::move(best_look), worn});
        if (looks.size() > kBefore) looks.erase(looks.begin());
    }
    return best;
}

}  // namespace

bool makes_uneven(const std::string& parameter) {
    return parameter.starts_with("uneven_") || parameter.starts_with("lean_");
}

std::map<std::string, double> person_shape(const Identity& identity, const DesignTables& tables) {
    const double age = (identity.age - 40) / 40, late = std::max(0.0, identity.age - 45) / 35;
    std::map<std::string, double> shape;
    for (const PopulationParameter& p : tables.population) {
        double value = p.mean + p.sex * identity.sex + p.age * age + p.late_age * late;
        for (std::size_t k = 0; k < tables.ancestries.size(); ++k)
            if (const auto share = identity.ancestry.find(tables.ancestries[k]);
                share != identity.ancestry.end())
                value += share->second * p.ancestry[k];
        if (const auto own = identity.shape.find(p.name); own != identity.shape.end())
            value += own->second;
        shape[p.name] = std::clamp(value, kPersonShapeRange.min, kPersonShapeRange.max);
    }
    return shape;
}

Identity random_person(unsigned seed, const PersonChoice& choice, const DesignTables& tables) {
    Draw draw(seed);
    Identity person = placed_person(seed, tables);
    const std::string ancestry = choice.ancestry.value_or(person.ancestry.begin()->first);
    person.sex = choice.sex.value_or(person.sex);
    person.age = choice.age.value_or(person.age);
    index_of_name("ancestry", ancestry, tables.ancestries);
    person.ancestry = {{ancestry, 1}};
    drawn_form(draw, tables);  // what follows it in the sequence does not depend on the row
    const auto [form, which_form] = form_in_row(seed, tables);
    // As all that makes people of rows distinct, what is usual in their sex is exaggerated.
    const double sex_again = in_row(seed) ? 2.0 * person.sex : 0;
    for (std::size_t k = 0; k < form.size(); ++k) {
        const PopulationParameter& p = tables.population[k];
        person.shape[p.name] = to_hundredths(std::clamp(form[k] + sex_again * p.sex, -kCut, kCut));
    }
    draw_colours(draw, ancestry, person);
    draw_hair(seed, ancestry, tables, person);
    draw_skin(seed, which_form, ancestry, person);
    person.hairdo.complexion = 1;
    person.hairdo.garment = "crew_neck";  // all wear the same
    return person;
}

}  // namespace risorius::headmodel
