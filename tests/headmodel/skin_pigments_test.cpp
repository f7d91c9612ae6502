// SPDX-License-Identifier: MIT
// Tones of the skin by its pigments: as measured on faces, and written with the angle that laboratories report.
#include "risorius/headmodel/detail/skin_pigments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "message_of.h"
#include "risorius/core/srgb.h"
#include "risorius/headmodel/detail/cast.h"
#include "risorius/headmodel/detail/population.h"
#include "temporary_folder.h"

namespace risorius::headmodel {
namespace {

const DesignTables& tone_tables() {
    static const DesignTables read = read_design_tables(models_folder() / "adult/design");
    return read;
}

/// a* under D65 with the light that the surface reflects, as an instrument that includes it reads it.
double redness(const Vec3& tone) {
    const Vec3 colour = tone.unaryExpr([](double c) { return linear_of_srgb(c) + 0.028; });
    const double x = colour.dot(Vec3(0.4124564, 0.3575761, 0.1804375)) / 0.95047,
                 y = colour.dot(Vec3(0.2126729, 0.7151522, 0.0721750));
    return 500 * (std::cbrt(x) - std::cbrt(y));
}

TEST(SkinPigments, HaveTheTypologyAngleOfTheirRow) {
    ASSERT_EQ(tone_tables().skin_pigments.size(), 10U);
    for (const PigmentTone& row : tone_tables().skin_pigments)
        EXPECT_NEAR(skin_colours(row.melanin, 0, tone_tables()).ita_deg, row.ita_deg, 1.3);
}

/// Standard deviations of a* at an ITA of 62, 38, 0 and -60 degrees: 2.0, 2.3, 2.1, 1.4 (ISSA, Lu et al. 2025).
TEST(SkinPigments, RedderByTheSpreadOfRednessThatWasMeasured) {
    for (const auto& [row, sd] : {std::pair{0, 2.0}, {2, 2.3}, {5, 2.1}, {9, 1.4}}) {
        const double melanin = tone_tables().skin_pigments[static_cast<std::size_t>(row)].melanin;
        const auto at = [&](double h) { return skin_colours(melanin, h, tone_tables()).skin; };
        EXPECT_NEAR(redness(at(1)) - redness(at(0)), sd, 0.1) << row;
        EXPECT_LT(redness(at(-1)), redness(at(0))) << row;
    }
}

/// Lips of Caucasian, Chinese and African women, linear red: 0.311, 0.257 and 0.134 beside cheeks of 0.425, 0.391 and 0.154 (Vergnaud
/// 2024, Charton 2026). The Chinese were not used.
TEST(SkinPigments, LipsAreAsDarkAsMeasuredBesideTheCheek) {
    const auto lips = [](double melanin) {
        return linear_of_srgb(skin_colours(melanin, 0, tone_tables()).lips.x());
    };
    EXPECT_NEAR(lips(0.205), 0.311, 0.004);
    EXPECT_NEAR(lips(0.2705), 0.257, 0.04);
    EXPECT_NEAR(lips(0.795), 0.134, 0.004);
}

/// Medians of facial ITA: 37 (Caucasian), 29 (Chinese), -35 degrees (African), ISSA 2025.
TEST(SkinPigments, DrawnPersonsAreAsDarkAsTheirGroup) {
    constexpr int kPersons = 300;
    for (const auto& [ancestry, ita] :
         {std::pair{std::string("european"), 37.0}, {"east_asian", 29.0}, {"african", -35.0}}) {
        double mean = 0, squares = 0;
        for (unsigned seed = 10001; seed <= 10000 + kPersons; ++seed) {  // in no row, drawn quickly
            const double one =
                skin_colours(random_person(seed, {.ancestry = ancestry}, tone_tables()),
                             tone_tables())
                    .ita_deg;
            mean += one / kPersons;
            squares += one * one / kPersons;
        }
        EXPECT_NEAR(mean, ita, 4) << ancestry;
        EXPECT_GT(squares - mean * mean, 8 * 8) << ancestry;
    }
}

TEST(SkinPigments, AreBlendedWhereBothPersonsHaveThem) {
    Identity light, dark;
    light.melanin = 0.2;
    dark.melanin = 0.8;
    dark.haemoglobin = 1;
    const Identity middle = morph(light, dark, 0.25);
    EXPECT_NEAR(middle.melanin.value(), 0.35, 1e-12);
    EXPECT_NEAR(middle.haemoglobin, 0.25, 1e-12);
    light.melanin.reset();
    EXPECT_FALSE(morph(light, dark, 0.25).melanin);
}

TEST(SkinPigments, LipstickReddensTheLipsOnly) {
    Identity bare, painted;
    bare.melanin = painted.melanin = 0.3;
    painted.lipstick = 1;
    const SkinColours with = skin_colours(painted, tone_tables()),
                      without = skin_colours(bare, tone_tables());
    EXPECT_EQ(with.skin, without.skin);
    EXPECT_LT(with.lips.y(), 0.6 * without.lips.y());
    EXPECT_GT(with.lips.x() / with.lips.y(), 1.5 * without.lips.x() / without.lips.y());
    // Not the same red on dark skin, where it would glow
    Identity dark = painted;
    dark.melanin = 0.95;
    EXPECT_LT(skin_colours(dark, tone_tables()).lips.x(), 0.85 * with.lips.x());
}

TEST(SkinPigments, SurviveAFileAndRefuseTwoTones) {
    const TemporaryFolder folder;
    const auto file = folder / "one.json";
    const auto read = [&](const std::string& fields) {
        std::ofstream(file) << R"({"format": "risorius-identity", "version": 1, )" << fields << "}";
        return read_identity(file, tone_tables());
    };
    const Identity one = read(R"("melanin": 0.35, "haemoglobin": -1.5, "skin_gloss": 0.5)");
    EXPECT_EQ(one.melanin, 0.35);
    std::ofstream(file) << identity_json(one).dump();
    EXPECT_EQ(identity_json(read_identity(file, tone_tables())).dump(), identity_json(one).dump());
    EXPECT_EQ(message_of([&] { read(R"("melanin": 0.35, "skin": "tan")"); }),
              file.string() + ":/melanin: expected a tone by melanin or by skin, found both");
    EXPECT_EQ(message_of([&] { read(R"("haemoglobin": 1)"); }),
              file.string() + ":/haemoglobin: expected melanin beside it, found none");
    EXPECT_EQ(message_of([&] { read(R"("melanin": 1.5)"); }),
              file.string() + ":/melanin: expected [0, 1], found 1.5");
    EXPECT_EQ(message_of([&] { read(R"("garment_tone": [0.1, 1.5, 0.2])"); }),
              file.string() + ":/garment_tone: expected red, green and blue in [0, 1], found 1.5");
    EXPECT_EQ(message_of([&] { read(R"("skin_gloss": 3)"); }),
              file.string() + ":/skin_gloss: expected [0, 2], found 3");
}

}  // namespace
}  // namespace risorius::headmodel
