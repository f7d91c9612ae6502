// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/identity.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/headmodel/detail/draw.h"

namespace risorius::headmodel {
namespace {

void check_range(const std::string& place, double value, Range range) {
    if (!(value >= range.min && value <= range.max))
        throw Error(place, "[" + format_number(range.min) + ", " + format_number(range.max) + "]",
                    format_number(value));
}

}  // namespace

std::vector<std::string> shape_parameters(const DesignTables& tables, Model model) {
    std::vector<std::string> names;
    if (model == Model::kPopulation) {
        for (const PopulationParameter& parameter : tables.population)
            names.push_back(parameter.name);
        return names;
    }
    for (const Handle& handle : tables.handles)
        if (handle.parameter != "sex" && handle.parameter != "age" &&
            std::find(names.begin(), names.end(), handle.parameter) == names.end())
            names.push_back(handle.parameter);
    return names;
}

std::vector<std::string> tone_names(const DesignTables& tables, const std::string& part) {
    std::vector<std::string> names;
    for (const auto& [name, tone] : tables.tones.at(part)) names.push_back(name);
    return names;
}

void check_identity(const Identity& identity, const DesignTables& tables, const PlaceOf& place) {
    check_range(place("sex"), identity.sex, kSexRange);
    check_range(place("age"), identity.age, kAgeRange);
    check_range(place("freckles"), identity.freckles, {0, 1});
    check_range(place("scalp_hair"), identity.scalp_hair, {0, 1});
    check_range(place("hairline"), identity.hairline, kHairRange);
    check_range(place("temples"), identity.temples, kHairRange);
    check_range(place("beard"), identity.beard, {0, 1});
    check_range(place("lipstick"), identity.lipstick, {0, 1});
    if (identity.melanin) check_range(place("melanin"), *identity.melanin, {0, 1});
    check_range(place("haemoglobin"), identity.haemoglobin, kRednessRange);
    check_identity_hair(identity.hairdo, place);
    const auto names = shape_parameters(tables, identity.model);
    const bool person = identity.model == Model::kPopulation;
    const auto other = shape_parameters(tables, person ? Model::kFamily : Model::kPopulation);
    const auto has = [](const std::vector<std::string>& all, const std::string& name) {
        return std::find(all.begin(), all.end(), name) != all.end();
    };
    for (const auto& [parameter, value] : identity.shape) {
        if (has(other, parameter) && !has(names, parameter))
            throw Error(
                place("shape"), person ? "a shape of model 2" : "a shape of model 1",
                "\"" + parameter + (person ? "\", which model 1 has" : "\", which model 2 has"));
        index_of_name(place("shape"), parameter, names);
        check_range(place("shape") + "/" + parameter, value,
                    person ? kPersonShapeRange : kShapeRange);
    }
    if (!person && !identity.ancestry.empty())
        throw Error(place("ancestry"), "none, as the model is 1", "one");
    double shares = 0;
    for (const auto& [name, share] : identity.ancestry) {
        index_of_name(place("ancestry"), name, tables.ancestries);
        check_range(place("ancestry") + "/" + name, share, {0, 1});
        shares += share;
    }
    if (!identity.ancestry.empty() && std::abs(shares - 1) > 1e-3)
        throw Error(place("ancestry"), "shares that sum to 1", format_number(shares));
    index_of_name(place("skin"), identity.skin, tone_names(tables, "skin"));
    index_of_name(place("iris"), identity.iris, tone_names(tables, "iris"));
    index_of_name(place("hair"), identity.hair, tone_names(tables, "hair"));
}

Identity read_identity(const std::filesystem::path& file, const DesignTables& tables) {
    const JsonCursor json = JsonCursor::read_file(file);
    std::vector<std::string_view> keys{"format", "version",  "name",        "model",    "ancestry",
                                       "sex",    "age",      "shape",       "skin",     "iris",
                                       "hair",   "freckles", "scalp_hair",  "hairline", "temples",
                                       "beard",  "melanin",  "haemoglobin", "lipstick"};
    keys.insert(keys.end(), identity_hair_keys().begin(), identity_hair_keys().end());
    json.allow_keys(keys);
    json.at("format").one_of({"risorius-identity"});
    json.at("version").integer(1, 1);
    Identity identity;
    identity.name = json.has("name") ? json.at("name").string() : file.stem().string();
    if (json.has("model")) identity.model = static_cast<Model>(json.at("model").integer(1, 2));
    if (const auto ancestry = json.find("ancestry"))
        for (const std::string& key : ancestry->keys())
            identity.ancestry[key] = ancestry->at(key).number();
    const auto number = [&](const char* key, double& value) {
        if (json.has(key)) value = json.at(key).number();
    };
    number("sex", identity.sex);
    number("age", identity.age);
    number("freckles", identity.freckles);
    number("scalp_hair", identity.scalp_hair);
    number("hairline", identity.hairline);
    number("temples", identity.temples);
    number("beard", identity.beard);
    if (const auto shape = json.find("shape"))
        for (const std::string& key : shape->keys()) identity.shape[key] = shape->at(key).number();
    const auto word = [&](const char* key, std::string& value) {
        if (json.has(key)) value = json.at(key).string();
    };
    word("skin", identity.skin);
    if (json.has("melanin")) {
        if (json.has("skin"))
            throw Error(json.at("melanin").place(), "a tone by melanin or by skin", "both");
        identity.melanin = json.at("melanin").number();
    }
    if (json.has("haemoglobin") && !identity.melanin)
        throw Error(json.at("haemoglobin").place(), "melanin beside it", "none");
    number("haemoglobin", identity.haemoglobin);
    number("lipstick", identity.lipstick);
    word("iris", identity.iris);
    word("hair", identity.hair);
    identity.hairdo = read_identity_hair(json);
    check_identity(identity, tables,
                   [&](const std::string& key) { return file.string() + ":/" + key; });
    return identity;
}

Json identity_json(const Identity& identity) {
    Json json;
    json["format"] = "risorius-identity";
    json["version"] = 1;
    json["name"] = identity.name;
    if (identity.model == Model::kPopulation) {
        json["model"] = static_cast<int>(identity.model);
        json["ancestry"] = Json::object();
        for (const auto& [name, share] : identity.ancestry) json["ancestry"][name] = share;
    }
    json["sex"] = identity.sex;
    json["age"] = identity.age;
    json["shape"] = Json::object();
    for (const auto& [parameter, value] : identity.shape) json["shape"][parameter] = value;
    if (identity.melanin) {
        json["melanin"] = *identity.melanin;
        json["haemoglobin"] = identity.haemoglobin;
    } else {
        json["skin"] = identity.skin;
    }
    if (identity.lipstick != 0) json["lipstick"] = identity.lipstick;
    json["iris"] = identity.iris;
    json["hair"] = identity.hair;
    json["freckles"] = identity.freckles;
    json["scalp_hair"] = identity.scalp_hair;
    json["hairline"] = identity.hairline;
    json["temples"] = identity.temples;
    json["beard"] = identity.beard;
    write_identity_hair(identity.hairdo, json);
    return json;
}

std::filesystem::path identity_file(const std::string& name) {
    return models_folder() / "identities" / (name + ".json");
}

std::vector<std::string> named_identities() {
    std::vector<std::string> names;
    const auto folder = models_folder() / "identities";
    if (std::filesystem::is_directory(folder))
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

Identity random_identity(unsigned seed, const DesignTables& tables) {
    constexpr double kSpread = 1.0, kYoungest = 20, kOldest = 75;
    Draw draw(seed);
    Identity identity;
    identity.name = "seed" + std::to_string(seed);
    identity.sex = draw.even() < 0.5 ? -1 : 1;
    identity.age = std::round(kYoungest + (kOldest - kYoungest) * draw.even());
    for (const std::string& parameter : shape_parameters(tables))
        identity.shape[parameter] =
            to_hundredths(std::clamp(kSpread * draw.normal(), kShapeRange.min, kShapeRange.max));
    identity.skin = draw.one_of(tone_names(tables, "skin"));
    const bool light = identity.skin == "pale" || identity.skin == "fair";
    identity.iris =
        light ? draw.one_of(tone_names(tables, "iris")) : draw.one_of({"hazel", "brown", "dark"});
    identity.hair =
        light ? draw.one_of({"black", "blond", "brown", "red"}) : draw.one_of({"black", "brown"});
    identity.freckles = to_hundredths(light ? 0.5 * draw.even() * draw.even() : 0.05);
    identity.beard = identity.sex > 0 ? to_hundredths(0.6 * draw.even()) : 0;
    // Men lose hair with the years, some much and most little.
    identity.hairline = to_hundredths(3 * draw.normal());
    const double lost =
        identity.sex > 0 ? (identity.age - 20) / 55 * draw.even() : 0.1 * draw.even();
    identity.hairline = to_hundredths(std::clamp(identity.hairline + 15 * lost, -8.0, 25.0));
    identity.temples = to_hundredths(25 * lost);
    return identity;
}

}  // namespace risorius::headmodel
