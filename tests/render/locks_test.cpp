// SPDX-License-Identifier: MIT
// Hair as locks over a cap: where they lie on the round head, and how they move with it.
#include "risorius/render/detail/locks.h"

#include <gtest/gtest.h>

#include <set>

#include "render/round_head.h"
#include "render/small_pictures.h"
#include "risorius/core/error.h"
#include "risorius/render/detail/crease_strokes.h"
#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/hair_styles.h"

namespace risorius::render {
namespace {

/// A round head whose hairline is known.
struct HairyHead : RoundHead {
    HairyHead() {
        scene.landmarks["tr"] = on_skin(0, 0.065);
        scene.landmarks["fht_l"] = on_skin(0.055, 0.045);
        scene.landmarks["fht_r"] = on_skin(-0.055, 0.045);
        scene.landmarks["op"] = Vec3(0, 0.02, -0.098);
        scene.landmarks["go_l"] = on_skin(0.06, -0.06);
    }
};

Hair hair_on(Scene scene, const std::string& style, unsigned seed = 1) {
    scene.appearance.hair_style = style;
    scene.appearance.seed = seed;
    const Vec3 centre = paint_centre(scene, Vec3::Constant(-0.1), Vec3::Constant(0.1));
    return plan_hair(scene, plan_skin(scene, centre), centre);
}

Points places_of(const Hair& hair, const Points& rest) {
    return pose_hair(hair, rest, rest).positions;
}

TEST(Locks, TheSameSeedGivesTheSameLocksAndAnotherSeedOthers) {
    const HairyHead head;
    const Points one = places_of(hair_on(head.scene, "short_parted"), head.scene.rest);
    EXPECT_EQ(one, places_of(hair_on(head.scene, "short_parted"), head.scene.rest));
    const Points other = places_of(hair_on(head.scene, "short_parted", 2), head.scene.rest);
    EXPECT_TRUE(one.rows() != other.rows() || one != other);
}

TEST(Locks, EveryStyleHasLocksThatLieOnTheHeadAndNoTwoAreAlike) {
    const HairyHead head;
    constexpr double kBelowSkin_m = 0.0005;  // as the skin is made of flat triangles
    std::set<std::size_t> counts;
    for (const std::string& style : hair_style_names()) {
        const Hair hair = hair_on(head.scene, style);
        EXPECT_EQ(hair.empty(), style == "shaven") << style;
        if (hair.empty()) continue;
        const Points places = places_of(hair, head.scene.rest);
        EXPECT_GE(places.rowwise().norm().minCoeff(), kHeadRadius_m - kBelowSkin_m) << style;
        EXPECT_TRUE(places.allFinite()) << style;
        counts.insert(hair.vertices.size());
    }
    EXPECT_EQ(counts.size() + 1, hair_style_names().size());
}

TEST(Locks, OuterLocksAndTheBorderOfTheCapAreSingleHairs) {
    const HairyHead head;
    const Hair hair = hair_on(head.scene, "bob");
    std::size_t with_gaps = 0, whole = 0;
    for (const HairPiece& piece : hair.pieces) {
        double side = 0, first = 1, last = 0;
        for (std::size_t i = 0; i < piece.vertices; ++i) {
            const HairVertex& v = hair.vertices[piece.first_vertex + i];
            side = std::max(side, std::abs(v.across));
            first = std::min(first, v.open);
            last = std::max(last, v.open);
        }
        EXPECT_EQ(first, 0);
        if (piece.columns == 0) {
            EXPECT_EQ(last, 1);
            EXPECT_EQ(side, 0);
        } else {
            ++(side > 0 ? with_gaps : whole);
            if (side > 0) EXPECT_GT(last, 0.5);
        }
    }
    EXPECT_GT(with_gaps, 50U);
    EXPECT_GT(whole, 50U);
}

TEST(Locks, ThereAreFewRowsWhereALockIsStraightAndAllOfThemWhereItCurls) {
    const HairyHead head;
    const auto rows = [&](const char* style) {  // mean of the locks that are no single hairs
        const Hair hair = hair_on(head.scene, style);
        double sum = 0, locks = 0;
        for (const HairPiece& piece : hair.pieces)
            if (piece.columns > 0 && piece.casts) {
                sum += static_cast<double>(piece.rows);
                ++locks;
                EXPECT_GE(piece.rows, 2U);
            }
        return sum / locks;
    };
    EXPECT_LT(rows("bob"), 0.65 * 25);         // of 24 segments
    EXPECT_GT(rows("curly_short"), 0.9 * 10);  // of 9
}

TEST(Locks, HairTurnsWithTheHead) {
    const HairyHead head;
    const Hair hair = hair_on(head.scene, "bob");
    const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(0.2, 0.9, -0.1).normalized()).toRotationMatrix();
    const Vec3 move(0.01, -0.02, 0.03);
    Points turned = (head.scene.rest * turn.transpose()).rowwise() + move.transpose();
    const PosedHair posed = pose_hair(hair, head.scene.rest, turned);
    const Points expected =
        (places_of(hair, head.scene.rest) * turn.transpose()).rowwise() + move.transpose();
    EXPECT_LT((posed.positions - expected).cwiseAbs().maxCoeff(), 1e-9);  // rounding of 0.1 m
    EXPECT_LT((posed.turned - turn).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Locks, LinesOfAgeAreThereOnlyWhenAskedForAndAreTheSameForTheSameSeed) {
    HairyHead head;
    head.scene.landmarks["g"] = RoundHead::on_skin(0, 0.03);
    head.scene.landmarks["ft_l"] = RoundHead::on_skin(0.055, 0.04);
    head.scene.appearance.age = 0.9;
    const auto count = [&] { return plan_creases(head.scene, Vec3::Zero()).size(); };
    EXPECT_EQ(count(), 0U);
    head.scene.appearance.age_lines = 1;
    const std::size_t old = count();
    EXPECT_GT(old, 100U);
    EXPECT_EQ(count(), old);
    head.scene.appearance.age = 0;
    EXPECT_EQ(count(), 0U) << "at 25 years";
}

TEST(Locks, WhiteHairsComeWithAgeUnlessTheirShareIsGiven) {
    Appearance appearance;
    appearance.hair_tone = {0.1, 0.1, 0.1};
    appearance.age = 0.9;  // 70 years
    EXPECT_NEAR(white_share(appearance), 0.80, 0.01);
    EXPECT_GT(hair_tone_at(appearance).x(), 0.4);
    appearance.grey_hair = 0.05;
    EXPECT_EQ(white_share(appearance), 0.05);
    EXPECT_LT(hair_tone_at(appearance).x(), 0.13);
    appearance.age = 0;
    EXPECT_EQ(white_share(appearance), 0.05);
}

TEST(Locks, AreAsLongAndPartedWhereTheAppearanceSays) {
    HairyHead head;
    const auto lowest = [&](double length) {
        head.scene.appearance.lock_length = length;
        return places_of(hair_on(head.scene, "bob"), head.scene.rest).col(1).minCoeff();
    };
    const double usual = lowest(1);
    EXPECT_NEAR(lowest(0.7), usual + 0.027, 0.005);
    EXPECT_NEAR(lowest(1.4), usual - 0.036, 0.005);
    const auto reach = [&](double length) {
        head.scene.appearance.lock_length = length;
        return places_of(hair_on(head.scene, "afro"), head.scene.rest).rowwise().norm().maxCoeff();
    };
    EXPECT_GT(reach(1.4), reach(1) + 0.008);
    head.scene.appearance.lock_length = 1;
    // A parting on the other side leaves more locks on this one.
    const auto on_left = [&](double parting) {
        head.scene.appearance.parting = parting;
        const Points places = places_of(hair_on(head.scene, "short_parted"), head.scene.rest);
        return static_cast<double>((places.col(0).array() > 0).count()) /
               static_cast<double>(places.rows());
    };
    EXPECT_GT(on_left(-1), on_left(1) + 0.05);
    const Points straight = places_of(hair_on(head.scene, "bob"), head.scene.rest);
    head.scene.appearance.lock_wave = 1;
    EXPECT_NE(straight, places_of(hair_on(head.scene, "bob"), head.scene.rest));
}

TEST(Locks, AFringeCoversTheForeheadAsFarAsItIsAskedFor) {
    HairyHead head;
    const auto lowest_in_front = [&](const char* style, double fringe) {
        head.scene.appearance.fringe = fringe;
        const Points places = places_of(hair_on(head.scene, style), head.scene.rest);
        double lowest = 1;
        for (Eigen::Index v = 0; v < places.rows(); ++v)
            if (places(v, 2) > 0.06 && std::abs(places(v, 0)) < 0.03)
                lowest = std::min(lowest, places(v, 1));
        return lowest;
    };
    const double brow = 0.02, strands = 0.006;  // in which locks end, below the height of the cut
    head.scene.landmarks["bm_l"] = RoundHead::on_skin(0.02, brow);
    EXPECT_GT(lowest_in_front("bob", 0), 0.045);
    EXPECT_NEAR(lowest_in_front("bob", 0.5), 0.5 * (0.065 + brow) - strands, 0.008);
    EXPECT_NEAR(lowest_in_front("bob", 1), brow - strands, 0.008);
    EXPECT_EQ(lowest_in_front("crop", 1), lowest_in_front("crop", 0)) << "has no parting";
}

TEST(Locks, BrowsAreDarkerThanBlondHairAndAsDarkAsOtherHair) {
    Appearance appearance;
    appearance.grey_hair = 0;
    for (const Vec3& tone :
         {Vec3(0.06, 0.05, 0.05), Vec3(0.22, 0.15, 0.10), Vec3(0.55, 0.54, 0.53)}) {
        appearance.hair_tone = tone;
        EXPECT_LT((hair_tone_at(appearance) - tone).norm(), 0.03) << tone.transpose();
    }
    appearance.hair_tone = {0.62, 0.48, 0.30};
    EXPECT_LT(hair_tone_at(appearance).x(), 0.45);
}

TEST(Locks, TheForeheadStaysFreeOfAShortStyle) {
    const HairyHead head;
    const Points places = places_of(hair_on(head.scene, "crop"), head.scene.rest);
    for (Eigen::Index v = 0; v < places.rows(); ++v)
        EXPECT_FALSE(places(v, 2) > 0.085 && std::abs(places(v, 0)) < 0.03);
}

TEST(Locks, AnUnknownStyleIsNamedWithTheOnesThatThereAre) {
    const HairyHead head;
    try {
        hair_on(head.scene, "bobb");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "hair_style: expected one of \"shaven\", \"crop\", \"short_parted\", "
                     "\"curly_short\", \"afro\", \"bob\", \"long_tied\", \"bald_fringe\" (did you "
                     "mean \"bob\"?), found \"bobb\"");
    }
}

TEST(Locks, HairOfAStyleIsSeenOverTheHeadAndShavenHeadsStayAsTheyAre) {
    HairyHead head;
    const ViewOptions options{.width_px = 128, .height_px = 128, .camera = "front"};
    const Image bare = OffscreenView(head.scene, options).draw(head.pose);
    head.scene.appearance.hair_style = "shaven";
    EXPECT_EQ(OffscreenView(head.scene, options).draw(head.pose).rgba, bare.rgba);
    head.scene.appearance.hair_style = "afro";
    head.scene.appearance.hair_tone = Vec3(0.05, 0.04, 0.03);
    OffscreenView view(head.scene, options);
    const Image hairy = view.draw(head.pose);
    EXPECT_EQ(view.draw(head.pose).rgba, hairy.rgba);
    const Vec3 above(0, kHeadRadius_m + 0.012, -0.01);
    EXPECT_LT(brightness_of(mean_colour(hairy, view.project(above), 1)),
              0.5 * brightness_of(mean_colour(bare, view.project(above), 1)));
}

}  // namespace
}  // namespace risorius::render
