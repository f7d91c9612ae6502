// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/identity_hair.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/render/garments.h"
#include "risorius/render/hair_styles.h"

namespace risorius::headmodel {

const std::vector<std::string_view>& identity_hair_keys() {
    static const std::vector<std::string_view> keys{
        "hair_style",   "hairline_form", "grey_hair",  "age_lines",  "seed",         "beard_form",
        "brow_density", "brow_width",    "skin_gloss", "garment",    "garment_tone", "lock_length",
        "lock_wave",    "fringe",        "parting",    "complexion", "mottling"};
    return keys;
}

IdentityHair read_identity_hair(const JsonCursor& json) {
    IdentityHair hair;
    if (json.has("hair_style")) hair.style = json.at("hair_style").string();
    if (json.has("hairline_form")) hair.hairline_form = json.at("hairline_form").string();
    if (json.has("grey_hair")) hair.grey = json.at("grey_hair").number();
    if (json.has("age_lines")) hair.age_lines = json.at("age_lines").number();
    if (json.has("seed")) hair.seed = json.at("seed").integer(0, std::numeric_limits<int>::max());
    if (json.has("beard_form")) hair.beard_form = json.at("beard_form").string();
    if (json.has("brow_density"))
        hair.brow_density = json.at("brow_density").number(kBrowDensityRange);
    if (json.has("brow_width")) hair.brow_width = json.at("brow_width").number(kBrowWidthRange);
    if (json.has("skin_gloss")) hair.skin_gloss = json.at("skin_gloss").number(kSkinGlossRange);
    if (json.has("complexion")) hair.complexion = json.at("complexion").number(kComplexionRange);
    if (json.has("mottling")) hair.mottling = json.at("mottling").number(kShareRange);
    if (json.has("lock_length")) hair.lock_length = json.at("lock_length").number(kLockLengthRange);
    if (json.has("lock_wave")) hair.lock_wave = json.at("lock_wave").number(kShareRange);
    if (json.has("fringe")) hair.fringe = json.at("fringe").number(kShareRange);
    if (json.has("parting")) hair.parting = json.at("parting").number(kPartingRange);
    if (json.has("garment")) hair.garment = json.at("garment").string();
    if (json.has("garment_tone")) hair.garment_tone = json.at("garment_tone").vec3();
    return hair;
}

void check_identity_hair(const IdentityHair& hair,
                         const std::function<std::string(const std::string& field)>& place) {
    index_of_name(place("hair_style"), hair.style, render::hair_style_names());
    index_of_name(place("hairline_form"), hair.hairline_form, render::hairline_form_names());
    index_of_name(place("garment"), hair.garment, render::garment_names());
    for (const double part : hair.garment_tone)
        if (!(part >= 0 && part <= 1))
            throw Error(place("garment_tone"), "red, green and blue in [0, 1]",
                        format_number(part));
    index_of_name(place("beard_form"), hair.beard_form, render::beard_form_names());
    for (const auto& [key, value] :
         {std::pair{"grey_hair", hair.grey.value_or(0)}, std::pair{"age_lines", hair.age_lines}})
        if (!(value >= 0 && value <= 1)) throw Error(place(key), "[0, 1]", format_number(value));
    if (!(hair.skin_gloss >= kSkinGlossRange.min && hair.skin_gloss <= kSkinGlossRange.max))
        throw Error(place("skin_gloss"), "[0, 2]", format_number(hair.skin_gloss));
}

void write_identity_hair(const IdentityHair& hair, Json& json) {
    const IdentityHair usual;
    if (hair.style != usual.style) json["hair_style"] = hair.style;
    if (hair.hairline_form != usual.hairline_form) json["hairline_form"] = hair.hairline_form;
    if (hair.lock_length != usual.lock_length) json["lock_length"] = hair.lock_length;
    if (hair.lock_wave != usual.lock_wave) json["lock_wave"] = hair.lock_wave;
    if (hair.fringe != usual.fringe) json["fringe"] = hair.fringe;
    if (hair.parting != usual.parting) json["parting"] = hair.parting;
    if (hair.grey) json["grey_hair"] = *hair.grey;
    if (hair.age_lines != usual.age_lines) json["age_lines"] = hair.age_lines;
    if (hair.seed != usual.seed) json["seed"] = hair.seed;
    if (hair.beard_form != usual.beard_form) json["beard_form"] = hair.beard_form;
    if (hair.brow_density != usual.brow_density) json["brow_density"] = hair.brow_density;
    if (hair.brow_width != usual.brow_width) json["brow_width"] = hair.brow_width;
    if (hair.garment != usual.garment) json["garment"] = hair.garment;
    if (const Vec3& tone = hair.garment_tone; tone != usual.garment_tone)
        json["garment_tone"] = {tone.x(), tone.y(), tone.z()};
    if (hair.skin_gloss != usual.skin_gloss) json["skin_gloss"] = hair.skin_gloss;
    if (hair.complexion != usual.complexion) json["complexion"] = hair.complexion;
    if (hair.mottling != usual.mottling) json["mottling"] = hair.mottling;
}

}  // namespace risorius::headmodel
