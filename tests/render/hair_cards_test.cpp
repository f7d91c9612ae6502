// SPDX-License-Identifier: MIT
// Hair for other programs: cards that lie where the locks do, with normals, and a picture that cuts their ends.
#include "risorius/render/hair_cards.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/round_head.h"
#include "risorius/render/detail/card_picture.h"
#include "risorius/render/detail/locks.h"
#include "risorius/render/hair_styles.h"

namespace risorius::render {
namespace {

/// A round head with a hairline and a style.
Scene head_with(const std::string& style) {
    Scene scene = RoundHead().scene;
    scene.landmarks["tr"] = RoundHead::on_skin(0, 0.065);
    scene.landmarks["fht_l"] = RoundHead::on_skin(0.055, 0.045);
    scene.landmarks["fht_r"] = RoundHead::on_skin(-0.055, 0.045);
    scene.landmarks["op"] = Vec3(0, 0.02, -0.098);
    scene.landmarks["go_l"] = RoundHead::on_skin(0.06, -0.06);
    scene.appearance.hair_style = style;
    return scene;
}

Vec3 corner(const HairCards& hair, const Triangles& triangles, long f, int k) {
    return hair.vertices.row(triangles(f, k)).transpose();
}

TEST(HairCards, EveryStyleHasACardForEachLockAndACap) {
    for (const std::string& style : hair_style_names()) {
        const Scene scene = head_with(style);
        const HairCards hair = hair_cards(scene);
        const Hair locks = plan_hair(scene);
        EXPECT_EQ(hair.empty(), style == "shaven") << style;
        if (hair.empty()) continue;
        const bool capped = locks.pieces.back().columns == 0;
        EXPECT_EQ(capped, style != "bald_fringe") << style;
        EXPECT_EQ(hair.cap.rows() > 0, capped) << style;
        EXPECT_EQ(hair.locks, static_cast<long>(locks.pieces.size()) - (capped ? 1 : 0)) << style;
        // At least two triangles a lock, and hardly more than the locks of our own pictures have
        EXPECT_GE(hair.cards.rows(), 2 * hair.locks) << style;
        EXPECT_LE(static_cast<double>(hair.cards.rows() + hair.cap.rows()),
                  1.01 * static_cast<double>(locks.triangles.size()) / 3)
            << style;
        for (const long rows : {hair.normals.rows(), hair.texcoords.rows(), hair.root.rows(),
                                hair.share.rows(), static_cast<long>(hair.shade.size())})
            EXPECT_EQ(rows, hair.vertices.rows()) << style;
        EXPECT_TRUE(hair.vertices.allFinite()) << style;
    }
}

TEST(HairCards, TheyAreSeenFromOutsideAndLitByUnitNormals) {
    for (const char* style : {"bob", "long_tied", "afro", "crop"}) {
        const HairCards hair = hair_cards(head_with(style));
        EXPECT_LT((hair.normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-9) << style;
        for (const Triangles* triangles : {&hair.cards, &hair.cap})
            for (long f = 0; f < triangles->rows(); ++f) {
                const Vec3 a = corner(hair, *triangles, f, 0), b = corner(hair, *triangles, f, 1),
                           c = corner(hair, *triangles, f, 2);
                Vec3 normal = Vec3::Zero();
                for (int k = 0; k < 3; ++k)
                    normal += hair.normals.row((*triangles)(f, k)).transpose();
                ASSERT_GT((b - a).cross(c - a).dot(normal), 0) << style;
            }
    }
}

TEST(HairCards, CardsShowOnePictureAndTheirShadeIsAShare) {
    for (const char* style : {"bob", "short_parted", "curly_short", "bald_fringe"}) {
        const HairCards hair = hair_cards(head_with(style));
        // The picture is not repeated: the ends of strands would show the roots above them.
        EXPECT_GE(hair.texcoords.minCoeff(), 0) << style;
        EXPECT_LE(hair.texcoords.maxCoeff(), 1) << style;
        const auto [least, most] = std::minmax_element(hair.shade.begin(), hair.shade.end());
        EXPECT_GT(*least, 0) << style;
        EXPECT_LE(*most, 1) << style;
        EXPECT_LT(*least, 0.8 * *most) << style << ": roots are darker";
    }
}

TEST(HairCards, TheyMoveWithTheSkinThatTheyGrowOn) {
    const HairCards hair = hair_cards(head_with("crop"));
    const Scene scene = head_with("crop");
    const Points lifted = Points::Constant(scene.rest.rows(), 3, 0.002);
    EXPECT_LT((hair.moved(lifted) - Points::Constant(hair.vertices.rows(), 3, 0.002))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9);
    EXPECT_TRUE(hair.moved(Points::Zero(scene.rest.rows(), 3)).isZero(0.0));
}

TEST(HairCards, ThePictureIsWholeAtTheRootsAndSingleStrandsAtTheEnds) {
    Appearance person;
    person.hair_tone = Vec3(0.3, 0.2, 0.1);
    person.grey_hair = 0;
    const Image picture = hair_card_picture(person);
    EXPECT_EQ(picture.rgba, hair_card_picture(person).rgba);
    const auto hairs_in = [&](int y) {
        int count = 0;
        for (int x = 0; x < picture.width_px; ++x)
            count += picture.pixel(x, y)[3] > 255 * kHairAlpha;
        return static_cast<double>(count) / picture.width_px;
    };
    const int body = static_cast<int>(kCardBody * picture.height_px);
    EXPECT_GT(hairs_in(2), 0.95);
    EXPECT_GT(hairs_in(body - 3), 0.70);
    EXPECT_LT(hairs_in(picture.height_px - 2), 0.25);
    EXPECT_GT(hairs_in(picture.height_px - 30), 0.10);
    // Between the rims all of the body is hair, whatever part of it a narrow card shows.
    const int cell = picture.width_px / static_cast<int>(kCardCells);
    for (std::size_t k = 0; k < kCardCells; ++k)
        for (int x = static_cast<int>(kCardRim * cell) + 1;
             x < static_cast<int>((1 - kCardRim) * cell); ++x)
            ASSERT_EQ(picture.pixel(static_cast<int>(k) * cell + x, body - 2)[3], 255);
    const auto mean = [](const Image& of) {
        double sum = 0;
        for (std::size_t i = 0; i < of.rgba.size(); i += 4) sum += of.rgba[i];
        return 4 * sum / static_cast<double>(of.rgba.size());
    };
    person.grey_hair = 0.7;
    EXPECT_GT(mean(hair_card_picture(person)), 1.3 * mean(picture));
}

}  // namespace
}  // namespace risorius::render
