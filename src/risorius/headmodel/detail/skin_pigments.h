// SPDX-License-Identifier: MIT
/// \file
/// Colours of skin and lips from the two pigments of the skin, melanin and haemoglobin.
#pragma once

#include "risorius/core/types.h"
#include "risorius/headmodel/detail/identity.h"

namespace risorius::headmodel {

struct SkinColours {
    Vec3 skin, lips;  ///< sRGB 0..1 without the light that the surface reflects
    double ita_deg;   ///< individual typology angle as an instrument reads it (Chardon 1991)
};

/// The colours of the cheek and of the lips. `melanin`: 0 the lightest skin of the table, 1 the darkest. `haemoglobin`: redness in
/// standard deviations from the mean of people of this tone. Lips follow the cheek by colour ** exponent between the means of
/// Caucasian and African women (Vergnaud 2024, Charton 2026).
SkinColours skin_colours(double melanin, double haemoglobin, const DesignTables& tables);

/// The colours of an identity: by its pigments or by name, and with lipstick.
SkinColours skin_colours(const Identity& identity, const DesignTables& tables);

/// The ITA of a tone in sRGB without the light that the surface reflects.
double typology_angle_deg(const Vec3& tone);

}  // namespace risorius::headmodel
