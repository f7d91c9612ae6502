// SPDX-License-Identifier: MIT
// A quantity on the skin: its colours are in order, where there is none is grey, and the face comes back as it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "render/round_head.h"
#include "risorius/core/error.h"
#include "risorius/render/lettering.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/render/value_colour.h"

namespace risorius::render {
namespace {

/// CIE L*
double lightness(const Vec3& linear) {
    const double y = linear.dot(Vec3(0.2126, 0.7152, 0.0722));
    return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

class ValuesView : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        head = std::make_unique<RoundHead>();
        ViewOptions options;
        options.width_px = options.height_px = 160;
        view = std::make_unique<OffscreenView>(head->scene, options);
    }
    static void TearDownTestSuite() { view.reset(); }

    static Image picture(double value) {
        Pose pose = head->pose;
        pose.values = {
            .name = "error",
            .unit = "mm",
            .from = 0,
            .to = 5,
            .at = std::vector<double>(static_cast<std::size_t>(head->scene.rest.rows()), value)};
        return view->draw(pose);
    }
    /// Of the forehead, 0..255.
    static Vec3 forehead(const Image& image) {
        const Vec2 at = view->project(RoundHead::on_skin(0.005, 0.055));
        const std::uint8_t* pixel = image.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()));
        return {static_cast<double>(pixel[0]), static_cast<double>(pixel[1]),
                static_cast<double>(pixel[2])};
    }
    static std::unique_ptr<RoundHead> head;
    static std::unique_ptr<OffscreenView> view;
};
std::unique_ptr<RoundHead> ValuesView::head;
std::unique_ptr<OffscreenView> ValuesView::view;

TEST_F(ValuesView, MoreIsDarker) {
    double before = 1e9;
    for (const double value : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
        const double sum = forehead(picture(value)).dot(Vec3(0.2126, 0.7152, 0.0722));
        EXPECT_LT(sum, before - 5) << value;
        before = sum;
    }
}

TEST_F(ValuesView, TheForeheadHasTheColourOfTheScale) {
    // Even light takes away a little of it at a slant
    for (const double value : {0.0, 2.5, 5.0}) {
        const Vec3 seen = forehead(picture(value)), said = 255 * srgb_of(value_colour(value, 0, 5));
        EXPECT_LT((seen - said).cwiseAbs().maxCoeff(), 36) << value;
    }
}

TEST_F(ValuesView, BeyondTheEndsStaysAtTheEnds) {
    EXPECT_EQ(picture(5).rgba, picture(50).rgba);
    EXPECT_EQ(picture(0).rgba, picture(-1).rgba);
}

TEST_F(ValuesView, WhereThereIsNoValueTheSkinIsGrey) {
    const Vec3 seen = forehead(picture(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_LE(seen.maxCoeff() - seen.minCoeff(), 3);
}

TEST_F(ValuesView, TheFaceComesBackAsItWas) {
    const Image before = view->draw(head->pose);
    const Image values = picture(2);
    EXPECT_NE(before.rgba, values.rgba);
    EXPECT_EQ(before.rgba, view->draw(head->pose).rgba);
    EXPECT_EQ(values.rgba, picture(2).rgba);
}

TEST_F(ValuesView, OneValueTooFewIsRefused) {
    Pose pose = head->pose;
    const std::string all = std::to_string(head->scene.rest.rows()),
                      one_less = std::to_string(head->scene.rest.rows() - 1);
    pose.values = SkinValues{};
    pose.values->at.resize(static_cast<std::size_t>(head->scene.rest.rows()) - 1);
    try {
        view->draw(pose);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()),
                  "pose/values: expected " + all + " values, found " + one_less);
    }
}

TEST(ValueColour, LightnessFallsEvenlyWithAQuantity) {
    for (int i = 0; i <= 20; ++i)
        EXPECT_NEAR(lightness(value_colour(i, 0, 20)), 90 - 70 * i / 20.0, 2.0) << i;
}

TEST(ValueColour, LightnessRisesWithAQuantityThatHasASign) {
    double before = 0;
    for (int i = -10; i <= 10; ++i) {
        const double now = lightness(value_colour(i, -10, 10));
        EXPECT_GT(now, before + 1) << i;
        before = now;
    }
    const Vec3 zero = value_colour(0, -10, 10);
    EXPECT_NEAR(zero.maxCoeff(), zero.minCoeff(), 1e-3);
}

TEST(Lettering, InkStaysWithinTheWidthOfTheText) {
    for (const std::string text : {"H", "mouthSmile_L", "0.87 (4 %)", "Wg"}) {
        const TextStyle style{.height_px = 20, .ink = 0};
        Image image(420, 60);
        std::fill(image.rgba.begin(), image.rgba.end(), std::uint8_t{255});
        write_text(text, {20, 40}, style, image);
        int first = 1000, last = -1;
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 420; ++x)
                if (image.pixel(x, y)[0] < 128) {
                    first = std::min(first, x);
                    last = std::max(last, x);
                }
        EXPECT_NEAR(first, 20, 3) << text;
        EXPECT_NEAR(last, 20 + 20 * text_width(text), 3) << text;
    }
}

TEST(Lettering, SignsStandAboveTheirLetters) {
    const auto ink = [](const std::string& text, int from_y, int to_y) {
        Image image(60, 60);
        std::fill(image.rgba.begin(), image.rgba.end(), std::uint8_t{255});
        write_text(text, {20, 40}, {.height_px = 20}, image);
        double sum = 0;
        for (int y = from_y; y < to_y; ++y)
            for (int x = 0; x < 60; ++x) sum += 255 - image.pixel(x, y)[0];
        return sum;
    };
    for (const auto& [with, without] :
         {std::pair{"ä", "a"}, {"ö", "o"}, {"å", "a"}, {"é", "e"}, {"ñ", "n"}, {"č", "c"}}) {
        EXPECT_DOUBLE_EQ(text_width(with), text_width(without));
        EXPECT_EQ(ink(with, 26, 60), ink(without, 26, 60))
            << with;  // from the top of small letters
        EXPECT_EQ(ink(without, 0, 25), 0) << without;
        EXPECT_GT(ink(with, 0, 25), 500) << with;
    }
    EXPECT_GT(ink("Ž", 0, 19), 500);
    EXPECT_EQ(ink("Z", 0, 18), 0);
}

// "ili" of eight pixels was one grey block: each stem lay half on two columns.
TEST(Lettering, StemsOfSmallLettersStandApart) {
    Image image(40, 20);
    std::fill(image.rgba.begin(), image.rgba.end(), std::uint8_t{255});
    write_text("ilili", {4, 14}, {.height_px = 8, .ink = 0}, image);
    int stems = 0;
    for (int x = 1; x < 39; ++x) {
        const int y = 11;
        if (image.pixel(x, y)[0] < 60 && image.pixel(x - 1, y)[0] > 150 &&
            image.pixel(x + 1, y)[0] > 150)
            ++stems;
    }
    EXPECT_EQ(stems, 5);
}

TEST(Lettering, APointStandsApartFromItsDigits) {
    for (const std::string text : {"1.5", "1.84", "0.75", "11.1"})
        for (double x = 4; x < 5; x += 0.1) {
            Image image(60, 20);
            std::fill(image.rgba.begin(), image.rgba.end(), std::uint8_t{255});
            write_text(text, {x, 14}, {.height_px = 9, .ink = 0}, image);
            const std::string before = text.substr(0, text.find('.'));
            const int from = static_cast<int>(x + 9 * text_width(before));
            int lightest = 0;
            for (int column = from; column < from + 3; ++column)
                lightest = std::max<int>(lightest, image.pixel(column, 13)[0]);
            EXPECT_GT(lightest, 150) << text << " at " << x;
        }
}

TEST(Lettering, TheSameLetterIsAsWideInAnyWord) {
    EXPECT_DOUBLE_EQ(text_width("mouth") - text_width("mout"), text_width("ah") - text_width("a"));
    EXPECT_EQ(text_width(""), 0);
    EXPECT_DOUBLE_EQ(text_width("\u0414"), text_width("\x01"));  // a box, not two
}

}  // namespace
}  // namespace risorius::render
