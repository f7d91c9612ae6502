// SPDX-License-Identifier: MIT
/// \file
/// What an identity says about how it is drawn beyond its tones: hair, lines of age, and the seed of all that is random.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"

namespace risorius::headmodel {

inline constexpr Range kShareRange{0, 1}, kBrowDensityRange{0, 3}, kBrowWidthRange{0.3, 2},
    kSkinGlossRange{0, 2}, kLockLengthRange{0.5, 1.5}, kPartingRange{-2, 2}, kComplexionRange{0, 2};

struct IdentityHair {
    std::string style = "shaven";        ///< a name of render::hair_style_names()
    std::string hairline_form = "even";  ///< a name of render::hairline_form_names()
    double lock_length = 1;              ///< 0.5..1.5, length of the locks against the style's
    double lock_wave = 0;                ///< 0..1, waves beside those of the style
    double fringe = 0;                   ///< 0..1, how far locks cover the forehead
    double parting = 1;                  ///< -2..2, place of the parting against the style's
    std::optional<double> grey;          ///< 0..1, share of white hairs; unset: as comes with age
    double age_lines = 0;                ///< 0..1, strength of the lines that come with age
    int seed = 1;                        ///< of locks, hairs, pores and spots
    std::string beard_form = "stubble";  ///< a name of render::beard_form_names()
    double brow_density = 1;             ///< 0..3, hairs of the brows against the usual number
    double brow_width = 1;               ///< 0.3..2, height of the brows against the usual one
    double skin_gloss = 1;  ///< 0..2, what the skin mirrors against the usual: powdered to oily
    double complexion =
        0;  ///< 0..2, how much of what the seed draws of shades, redness and moles is seen
    double mottling = 0;                  ///< 0..1, how uneven the colour of the skin is
    std::string garment = "none";         ///< a name of render::garment_names()
    Vec3 garment_tone{0.30, 0.32, 0.36};  ///< sRGB
    bool operator==(const IdentityHair&) const = default;
};

/// The keys of an identity file that read_identity_hair() reads.
const std::vector<std::string_view>& identity_hair_keys();
IdentityHair read_identity_hair(const JsonCursor& json);
/// Throws Error on unknown names and on values out of range. `place` returns the place of a key.
void check_identity_hair(const IdentityHair& hair,
                         const std::function<std::string(const std::string& field)>& place);
/// Adds the keys that differ from the default, to an identity and to the appearance of a rig alike.
void write_identity_hair(const IdentityHair& hair, Json& json);

}  // namespace risorius::headmodel
