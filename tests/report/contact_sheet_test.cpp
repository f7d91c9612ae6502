// SPDX-License-Identifier: MIT
// Small pictures on one sheet.
#include "risorius/report/contact_sheet.h"

#include <gtest/gtest.h>

namespace risorius::report {
namespace {

TEST(ContactSheet, ASmallPictureHasTheMeanOfTheLarge) {
    Image image(5, 4);
    double sum = 0;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        image.rgba[i] = static_cast<std::uint8_t>(i % 4 == 0 ? (37 * i) % 251 : 255);
        if (i % 4 == 0) sum += image.rgba[i];
    }
    EXPECT_NEAR(shrunk(image, 1, 1).rgba[0], sum / 20, 0.51);
    EXPECT_EQ(shrunk(image, 5, 4).rgba, image.rgba);
    const Image small = shrunk(image, 2, 3);
    double mean = 0;
    for (std::size_t i = 0; i < small.rgba.size(); i += 4) mean += small.rgba[i] / 6.0;
    EXPECT_NEAR(mean, sum / 20, 0.51);
}

TEST(ContactSheet, ManyRowsStandSideBySide) {
    ContactSheet sheet{"title", {"a", "b"}, {}, {.name = "error", .unit = "mm", .to = 6, .at = {}}};
    for (int r = 0; r < 30; ++r) sheet.rows.push_back({"row", "", {Image(60, 70), Image(60, 70)}});
    const Image image = draw_contact_sheet(sheet);
    EXPECT_LT(image.width_px, 2 * image.height_px);
    EXPECT_LT(image.height_px, 2 * image.width_px);
}

}  // namespace
}  // namespace risorius::report
