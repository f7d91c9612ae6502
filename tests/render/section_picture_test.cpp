// SPDX-License-Identifier: MIT
#include "risorius/render/section_picture.h"

#include <gtest/gtest.h>

namespace risorius::render {
namespace {

Image paper(int side) { return Image(side, side); }

SectionPart box(double from, double to) {
    const Vec2 a(from, from), b(to, from), c(to, to), d(from, to);
    return {{{a, b}, {c, d}, {b, c}, {d, a}}, Vec3::Zero(), 1, 0};
}

TEST(SectionPicture, TheAreaOfABodyIsThatOfItsSegments) {
    Image image = paper(20);
    draw_sections({box(4.25, 14.75)}, image);
    double dark = 0;
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) dark += (246 - image.pixel(x, y)[0]) / 246.0;
    EXPECT_NEAR(dark, 10.5 * 10.5, 1);
    EXPECT_EQ(image.pixel(0, 0)[0], 246);
    EXPECT_EQ(image.pixel(0, 0)[3], 255);
    EXPECT_EQ(image.pixel(10, 10)[0], 0);
}

TEST(SectionPicture, WhatDoesNotCloseHasLinesOnly) {
    SectionPart open = box(4, 14);
    open.segments.pop_back();
    open.line_px = 2;
    Image image = paper(20);
    draw_sections({open}, image);
    EXPECT_EQ(image.pixel(9, 9)[0], 246);
    EXPECT_LT(image.pixel(13, 9)[0], 60);
}

}  // namespace
}  // namespace risorius::render
